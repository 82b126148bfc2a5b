//! How the stains of a film are shown, as its coating has it.

use bevy::{
    color::ColorToComponents,
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        system::Query,
    },
    math::Vec3,
    reflect::prelude::*,
};

use super::FilmDisplay;
use crate::{
    plugin::{CoatedBy, Coating},
    shown::{
        ShownChange,
        look::{StainLook, StainPart, StainPattern, StainSample, SurfaceLook},
    },
    stain::StainFields,
};

/// Streaks whose direction differs by less (1 - cosine) are the same: about a degree.
const SAME_DIRECTION: f32 = 1.5e-4;

/// How stains are shown on the front of the paint. Backs of flakes and bare metal, which are the plugin's own, always
/// show theirs: with a material of their own where that is chosen and there is one, else with vertex colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum StainDisplay {
    /// While it is coated, the prop's `StandardMaterial` is replaced by an extension of it that draws stains in detail
    /// (`StainedMaterial`); everything else of it stays as it is. Without feature `render`, or in an app without
    /// Bevy's `PbrPlugin`, the same as [`None`](Self::None).
    #[default]
    Material,
    /// The prop's material is not touched: stains go into the colours of the film's vertices, over those that the prop
    /// has. Less detail, but works with any material that heeds vertex colours.
    VertexColor,
    /// Stains are not shown on the paint.
    None,
}

/// What a film's meshes and materials must be told to show its stains.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FilmPaint {
    pub display: StainDisplay,
    pub look: StainLook,
    pub pattern: StainPattern,
    /// Linear colour of the paint's back.
    pub primer: Vec3,
}

impl FilmPaint {
    /// That of a film of `coating` on which stains have run along `streaks`.
    pub fn new(coating: &Coating, streaks: Vec3) -> Self {
        Self {
            display: coating.stain_display,
            look: coating.look(),
            pattern: StainPattern::new(coating.seed, streaks),
            primer: coating.primer.to_linear().to_vec3(),
        }
    }

    /// The same, with streaks along `streaks`; as it is where they run that way already.
    fn turn(&mut self, streaks: Vec3) -> bool {
        let (old, new) = (self.pattern.streaks, streaks.normalize_or_zero());
        let turned = old.dot(new) < 1.0 - SAME_DIRECTION && old != new;
        if turned {
            self.pattern.streaks = new;
        }
        turned
    }

    /// The look of the back of clean paint.
    pub fn primer_look(&self) -> SurfaceLook {
        SurfaceLook { base_color: self.primer, metallic: 0.0, roughness: 0.85, reflectance: 0.3, height: 0.0 }
    }

    /// Colour of one vertex of `part` whose own colour is `own`. Detail finer than `edge`, the distance between
    /// vertices, is averaged.
    pub fn color(&self, part: StainPart, own: [f32; 4], sample: &StainSample, edge: f32) -> [f32; 4] {
        let [red, green, blue, alpha] = own;
        let own = SurfaceLook { base_color: Vec3::new(red, green, blue), ..self.primer_look() };
        let base = if part == StainPart::Back { self.primer_look() } else { own };
        let pattern = self.pattern.with_footprint(edge);
        let look = self.look.part(part, base, sample, &pattern);
        look.base_color.extend(alpha).to_array()
    }
}

/// Hands changed looks, displays and directions of streaks to the films.
pub(super) fn follow_coatings(
    coatings: Query<Ref<Coating>>,
    mut films: Query<(&CoatedBy, Ref<StainFields>, &mut FilmDisplay)>,
) {
    for (coated_by, stains, mut display) in &mut films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let new = display.is_added();
        let display = display.bypass_change_detection();
        let turned = (new || stains.is_changed()) && display.paint.turn(stains.streaks);
        if !(new || coating.is_changed() || turned) {
            continue;
        }
        let paint = FilmPaint::new(&coating, display.paint.pattern.streaks);
        if !turned && paint == display.paint {
            continue;
        }
        let other = paint.display != display.paint.display;
        display.paint = paint;
        display.repainted(ShownChange { topology: other, exposure: other, stains: true });
    }
}
