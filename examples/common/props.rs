//! From meshes to films: the triangle budget and the build.

use bevy_coating::{
    deform::SolverQuality,
    remesh::{self, BuiltFilm, FilmResolution},
    settings::CoatingSettings,
    sim::FilmState,
    surface::{BuildError, BuildWarning, Surface},
};
use bevy_math::Vec3;

use super::{BakeError, MaterialLibrary, Model, ModelMesh, Slot, parallel};

/// Most triangles that can be asked for.
pub const MAX_TRIANGLES: u32 = remesh::MAX_FILM_TRIANGLES as u32;

/// Fewest triangles of a film, however small its share of the surface is.
const LEAST_TRIANGLES: u32 = 12;

/// How fine the films are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolution {
    /// About so many triangles for all films together.
    Triangles(u32),
    /// The meshes as they are.
    Keep,
}

/// A prop and the film that was made for it.
#[derive(Clone, Debug)]
pub struct Prop {
    /// Its name.
    pub name: String,
    /// Its own surface, around [`Self::origin`].
    pub surface: Surface,
    /// Where in the scene the surface's zero lies.
    pub origin: Vec3,
    /// Its primitives.
    pub slots: Vec<Slot>,
    /// The film at rest.
    pub built: BuiltFilm,
    /// Seed of its film.
    pub seed: u64,
}

/// Props with films, one to one.
#[derive(Debug, Default)]
pub struct Coated {
    pub props: Vec<Prop>,
    pub films: Vec<FilmState>,
    pub warnings: Vec<String>,
}

/// What every film is made with.
pub struct Coating<'a> {
    pub resolution: Resolution,
    pub settings: &'a CoatingSettings,
    pub seed: u64,
    pub steps_per_age: u32,
    pub quality: SolverQuality,
}

/// Makes a film for every mesh. Meshes that are all slivers are left out with a warning, unless there is
/// nothing else.
pub fn coat(origin: &str, meshes: Vec<ModelMesh>, coating: &Coating) -> Result<Coated, BakeError> {
    let areas: Vec<f64> = meshes.iter().map(|mesh| area(&mesh.surface)).collect();
    let resolutions: Vec<FilmResolution> = match coating.resolution {
        Resolution::Keep => vec![FilmResolution::Keep; meshes.len()],
        Resolution::Triangles(budget) => share(budget, &areas).into_iter().map(FilmResolution::Triangles).collect(),
    };
    let mut jobs: Vec<Job> = meshes
        .into_iter()
        .zip(resolutions)
        .enumerate()
        .map(|(i, (mesh, resolution))| Job { seed: film_seed(coating.seed, i), mesh, resolution, result: None })
        .collect();
    parallel::for_each(&mut jobs, |job| job.run(coating));

    let mut coated = Coated::default();
    let mut nothing = None;
    for Job { mesh, result, seed, .. } in jobs {
        let ModelMesh { name, surface, origin: place, slots, .. } = mesh;
        let broken = |cause: &str| BakeError::Broken { origin: origin.into(), mesh: name.clone(), cause: cause.into() };
        match result {
            Some(Ok((built, film))) => {
                coated.warnings.extend(built.warnings.iter().map(|w| format!("{name}: {}", warning(w))));
                coated.films.push(film.ok_or_else(|| broken("its faces are no oriented manifold"))?);
                coated.props.push(Prop { name, surface, origin: place, slots, built, seed });
            }
            Some(Err(source @ (BuildError::NoTriangles | BuildError::AllDegenerate { .. }))) => {
                coated.warnings.push(format!("{name}: left out: {source}"));
                nothing = Some(BakeError::Build { origin: origin.into(), mesh: name, source });
            }
            Some(Err(source)) => return Err(BakeError::Build { origin: origin.into(), mesh: name, source }),
            None => return Err(broken("it was not built")),
        }
    }
    match nothing {
        Some(error) if coated.films.is_empty() => Err(error),
        _ => Ok(coated),
    }
}

/// The build of one film.
struct Job {
    mesh: ModelMesh,
    resolution: FilmResolution,
    seed: u64,
    result: Option<Result<(BuiltFilm, Option<FilmState>), BuildError>>,
}

impl Job {
    fn run(&mut self, coating: &Coating) {
        let built = match self.mesh.film.take() {
            Some(film) => Ok(film),
            None => remesh::build_film(&self.mesh.surface, self.resolution, self.seed),
        };
        self.result = Some(built.map(|built| {
            let mut film = FilmState::new(&built, coating.settings, self.seed, coating.steps_per_age);
            if let Some(film) = &mut film {
                film.quality = coating.quality;
            }
            (built, film)
        }));
    }
}

/// The seed of film `index`. The first film has the seed itself, so that one mesh alone and the same mesh as
/// the first of many age alike; others differ, so that four wheels do not crack alike.
fn film_seed(seed: u64, index: usize) -> u64 {
    seed.wrapping_add((index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Shares `budget` triangles by area. Films too small for [`LEAST_TRIANGLES`] get that; the others share
/// the rest.
fn share(budget: u32, areas: &[f64]) -> Vec<u32> {
    if let [_] = areas {
        return vec![budget];
    }
    let least = f64::from(LEAST_TRIANGLES);
    let mut small = vec![false; areas.len()];
    loop {
        let taken = small.iter().filter(|&&small| small).count() as f64 * least;
        let rest = (f64::from(budget) - taken).max(0.0);
        let area: f64 = areas.iter().zip(&small).filter(|&(_, &small)| !small).map(|(&area, _)| area).sum();
        let part = |own: f64| if area > 0.0 { rest * own / area } else { 0.0 };
        let mut changed = false;
        for (&own, small) in areas.iter().zip(&mut small) {
            if !*small && part(own) < least {
                (*small, changed) = (true, true);
            }
        }
        if !changed {
            let parts = areas.iter().zip(&small);
            return parts
                .map(|(&own, &small)| if small { LEAST_TRIANGLES } else { part(own).round() as u32 })
                .collect();
        }
    }
}

/// Area of all triangles that can be measured.
fn area(surface: &Surface) -> f64 {
    let corner = |v: u32| surface.positions.get(v as usize).map(|p| p.as_dvec3());
    let areas = surface.triangles.iter().filter_map(|&[a, b, c]| {
        let (a, b, c) = (corner(a)?, corner(b)?, corner(c)?);
        Some((b - a).cross(c - a).length() * 0.5).filter(|area| area.is_finite())
    });
    areas.sum()
}

fn warning(warning: &BuildWarning) -> String {
    match warning {
        BuildWarning::DegenerateDropped(n) => format!("{n} triangles without area were dropped"),
        BuildWarning::DuplicatesDropped(n) => format!("{n} repeated triangles were dropped"),
        BuildWarning::NonManifoldEdgesSplit(n) => format!("{n} edges with more than two faces were split"),
        BuildWarning::NonManifoldVerticesSplit(n) => format!("{n} vertices where sheets met in a point were split"),
        BuildWarning::WindingTurned(n) => format!("{n} triangles were turned over to face like their shell"),
        BuildWarning::FeaturesDenserThanTarget { target, triangles } => {
            format!("its creases and seams are finer than {target} triangles can follow: {triangles} were used")
        }
        other => format!("{other:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_budget_is_shared_by_area_with_a_minimum() {
        assert_eq!(share(4000, &[2.0]), [4000]);
        assert_eq!(share(1000, &[3.0, 1.0]), [750, 250]);
        assert_eq!(share(1000, &[1.0, 1e-9]), [988, LEAST_TRIANGLES]);
        assert_eq!(share(4, &[1.0, 1.0]), [LEAST_TRIANGLES; 2]);
        assert_eq!(share(100, &[0.0, 0.0]), [LEAST_TRIANGLES; 2]);
    }
}
