//! Decides when stains look different: once any differs by more than display can show from what it was.

use bevy_math::Vec3;

use super::layer::StainLayer;

/// Change of a value from 0 to 1 up to which it looks the same: a step of a colour of 8 bits.
const STEP: f32 = 1.0 / 255.0;

/// Layers of rust beyond which more rust looks the same. Without this limit almost the whole edge between a vertex with
/// many layers and a clean vertex would be covered, and stains would show the outlines of triangles.
pub(crate) const MOST_LAYERS: f32 = 1.0;

/// Cover of first rust per corrosion: the spots have grown together over all of the metal long before it is fully
/// rusted.
pub(crate) const FIRST_RUST: f32 = 3.2;

/// Stains as they were when they last counted as changed. Whatever creeps adds up against them, so that no change is
/// missed for being slow.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shown {
    film: ShownLayer,
    metal: ShownLayer,
    corrosion: Vec<f32>,
    /// Unit vector along the streaks, or zero.
    streaks: Vec3,
}

impl Shown {
    /// Returns whether any stain looks different from how it was shown: of the film, of the metal with its corrosion,
    /// or the direction of streaks.
    pub fn differs(&self, film: &StainLayer, metal: &StainLayer, corrosion: &[f32], streaks: Vec3) -> bool {
        self.streaks.distance_squared(streaks.normalize_or_zero()) > STEP * STEP
            || self.film.differs(film)
            || self.metal.differs(metal)
            || any_far(corrosion, &self.corrosion, &metal.areas)
    }

    /// Notes how stains look now.
    pub fn note(&mut self, film: &StainLayer, metal: &StainLayer, corrosion: &[f32], streaks: Vec3) {
        self.film.note(film);
        self.metal.note(metal);
        self.corrosion.clear();
        self.corrosion.extend_from_slice(corrosion);
        self.streaks = streaks.normalize_or_zero();
    }
}

/// Stains of a layer as display showed them last: each list holds one entry for each vertex of the layer.
#[derive(Clone, Debug, Default, PartialEq)]
struct ShownLayer {
    rust: Vec<f32>,
    dust: Vec<f32>,
    moisture: Vec<f32>,
}

impl ShownLayer {
    fn differs(&self, now: &StainLayer) -> bool {
        self.rust.len() != now.areas.len()
            || self.any_rust_far(now)
            || any_far(&now.dust, &self.dust, &now.areas)
            || any_far(&now.moisture, &self.moisture, &now.areas)
    }

    fn any_rust_far(&self, now: &StainLayer) -> bool {
        let chunks = now.wet.chunks(CHUNK).zip(now.stained.chunks(CHUNK));
        chunks.zip(self.rust.chunks(CHUNK).zip(now.areas.chunks(CHUNK))).any(|((wet, stained), (shown, areas))| {
            let now = wet.iter().zip(stained).map(|(wet, stained)| seen_rust(wet + stained));
            now.zip(shown).zip(areas).fold(false, |any, ((now, shown), area)| any | is_far(now, *shown, *area))
        })
    }

    fn note(&mut self, now: &StainLayer) {
        let Self { rust, dust, moisture } = self;
        rust.resize(now.wet.len(), 0.0);
        for (rust, (wet, stained)) in rust.iter_mut().zip(now.wet.iter().zip(&now.stained)) {
            *rust = seen_rust(wet + stained);
        }
        for (shown, now) in [(dust, &now.dust), (moisture, &now.moisture)] {
            shown.clear();
            shown.extend_from_slice(now);
        }
    }
}

/// Values that are compared before a look at the result: compilers make packed code of a loop without a way out.
const CHUNK: usize = 64;

fn seen_rust(rust: f32) -> f32 {
    if rust < MOST_LAYERS { rust } else { MOST_LAYERS }
}

/// Returns whether a value looks different from what was shown. Where there are no faces nothing is seen.
fn is_far(now: f32, shown: f32, area: f32) -> bool {
    (area > 0.0) & !((now - shown).abs() <= STEP)
}

fn any_far(now: &[f32], shown: &[f32], areas: &[f32]) -> bool {
    now.chunks(CHUNK).zip(shown.chunks(CHUNK)).zip(areas.chunks(CHUNK)).any(|((now, shown), areas)| {
        now.iter().zip(shown).zip(areas).fold(false, |any, ((now, shown), area)| any | is_far(*now, *shown, *area))
    })
}
