//! Keeps the figures of one film up to date.

use super::{
    covers,
    crack_sums::CrackSums,
    gone_sums::GoneSums,
    shares::{FilmShares, share},
    view::FilmView,
};
use crate::{sim::FilmState, stain::StainLayer};

/// Keeper of the [`FilmShares`] of one film, who looks at the film again only where something has changed.
///
/// ```
/// use bevy_coating::{
///     remesh::sample,
///     settings::CoatingSettings,
///     sim::FilmState,
///     stain::Environment,
///     survey::FilmSurvey,
/// };
///
/// let (settings, environment) = (CoatingSettings::default(), Environment::default());
/// let piece = sample::plate(100, 7)?;
/// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
/// let mut survey = FilmSurvey::default();
/// assert!(survey.update(film.view()));
/// assert!(!survey.update(film.view()), "nothing has changed");
/// film.age_to(0.5, &settings, &environment);
/// assert!(survey.update(film.view()));
/// assert_eq!(survey.shares(), &film.shares());
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmSurvey {
    seen: Option<Seen>,
    cracks: CrackSums,
    gone: GoneSums,
    shares: FilmShares,
}

/// Marks that tell whether a film has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Seen {
    torn: u32,
    removed: usize,
    separations: u32,
    /// Number of vertices, and of faces that are left out.
    sizes: (usize, usize),
    stains: u32,
}

impl Seen {
    fn of(view: FilmView) -> Self {
        Self {
            torn: view.forces.torn_edges,
            removed: view.mesh.topology.removed_face_count(),
            separations: view.forces.separations,
            sizes: (view.mesh.topology.vertex_count(), view.hidden.iter().filter(|hidden| **hidden).count()),
            stains: view.stains.revision,
        }
    }

    /// Returns whether cracks and bare places are the same.
    fn is_as_whole(&self, other: &Self) -> bool {
        (self.torn, self.removed, self.sizes) == (other.torn, other.removed, other.sizes)
    }
}

impl FilmSurvey {
    /// Returns the figures as they were at the last update; all 0 before the first.
    pub fn shares(&self) -> &FilmShares {
        &self.shares
    }

    /// Brings the figures up to date if the film has separated, torn, lost faces or stained visibly since the last
    /// time. Returns whether it has.
    ///
    /// Movement alone, by which cracks gape wider, is not looked for: [`look`](Self::look) takes it into account.
    pub fn update(&mut self, view: FilmView) -> bool {
        let changed = self.seen != Some(Seen::of(view));
        if changed {
            self.look(view);
        }
        changed
    }

    /// Brings the figures up to date, whether the film has changed or has only moved.
    pub fn look(&mut self, view: FilmView) {
        let seen = Seen::of(view);
        if !self.seen.is_some_and(|before| before.is_as_whole(&seen)) {
            self.cracks.find(view);
            self.gone.find(view);
        }
        self.seen = Some(seen);
        self.cracks.measure(view);
        self.shares = self.sum(view);
    }

    /// Adds up the figures.
    fn sum(&self, view: FilmView) -> FilmShares {
        let Self { cracks, gone, .. } = self;
        // Areas of vertices tell nothing of hidden faces.
        let own: Vec<f32>;
        let areas = if view.hidden.is_empty() {
            &view.stains.film.areas
        } else {
            own = shown_areas(view);
            &own
        };
        let [mut film, mut separated] = [0.0f64; 2];
        for (&area, &since) in areas.iter().zip(&view.forces.separated_age) {
            let area = f64::from(area);
            film += area;
            separated += if since < f32::INFINITY { area } else { 0.0 };
        }
        let bare: f64 = gone.areas.iter().sum();
        let on_film = Stains::of(areas, &view.stains.film);
        let on_metal = Stains::of(&gone.weights, &view.stains.metal);
        let area = film + bare;
        let of = |part: f64| share(part, area);
        FilmShares {
            area,
            attached: of(film - separated),
            separated: of(separated),
            gone: of(bare),
            rusted: of(gone.rusted(&view.stains.corrosion) + cracks.rusted).min(1.0),
            stained: of(on_film.stained + on_metal.stained),
            dusty: of(on_film.dusty + on_metal.dusty),
            wet: of(on_film.wet + on_metal.wet),
            crack_density: of(cracks.lengths.iter().sum()),
            cracks: cracks.count,
            crack_sizes: cracks.lengths.map(of),
            gone_sizes: gone.areas.map(of),
        }
    }
}

/// Returns a third of the live faces at each film vertex that are not left out, in square metres.
fn shown_areas(view: FilmView) -> Vec<f32> {
    let mut areas = vec![0.0; view.mesh.topology.vertex_count()];
    for face in view.faces().filter(|face| face.live) {
        let third = view.mesh.geometry.rest_area_of(&view.mesh.topology, face.id) / 3.0;
        face.corners.iter().for_each(|v| areas[v.index()] += third);
    }
    areas
}

/// Stains of a layer, each times the area that it is on.
#[derive(Default)]
struct Stains {
    stained: f64,
    dusty: f64,
    wet: f64,
}

impl Stains {
    fn of(areas: &[f32], layer: &StainLayer) -> Self {
        let mut sums = Self::default();
        let rust = layer.wet.iter().zip(&layer.stained);
        for ((&area, (wet, stained)), (&dust, &moisture)) in
            areas.iter().zip(rust).zip(layer.dust.iter().zip(&layer.moisture))
        {
            sums.stained += f64::from(area * covers::stained(wet + stained));
            sums.dusty += f64::from(area * dust);
            sums.wet += f64::from(area * moisture);
        }
        sums
    }
}

impl FilmView<'_> {
    /// Returns the figures of the film as it is now. A [`FilmSurvey`] keeps them up to date for less.
    pub fn shares(&self) -> FilmShares {
        let mut survey = FilmSurvey::default();
        survey.look(*self);
        survey.shares
    }
}

impl FilmState {
    /// Returns the figures of the film by area as it is now. See [`FilmShares`] for an example.
    pub fn shares(&self) -> FilmShares {
        self.view().shares()
    }
}
