//! Makes films of meshes, which share triangles.

use std::collections::BTreeMap;

use bevy_math::{DMat4, DVec3, Vec3};

use super::{
    error::{BakeError, BrokenFilm},
    model::{ModelMesh, Place, Slot},
    options::BakeOptions,
    parallel,
    warning::BakeWarning,
};
use crate::{
    remesh::{self, BuiltFilm, FilmTarget, film_targets},
    sim::{FilmState, PathStep, coarser_than_grain, film_seed},
    surface::{BuildError, Surface},
};

/// A prop and the film that was made for it.
#[derive(Clone, Debug)]
pub struct Prop {
    /// Name of the node or mesh.
    pub name: String,
    /// The prop's own surface in metres, around [`Self::origin`].
    pub surface: Surface,
    /// Place in the scene where the surface's zero lies, in metres.
    pub origin: Vec3,
    /// Metres that a unit of the scene is long.
    pub metres_per_unit: f32,
    /// Attributes and material of each slot of the surface.
    pub slots: Vec<Slot>,
    /// Place in the document that the model was read from, with its transform into the scene in metres.
    pub place: Option<Place>,
    /// The film at rest.
    pub built: BuiltFilm,
    /// Seed of the film. A prop alone has the seed of the options; of several props, each has one that follows from it
    /// and from the prop's name.
    pub seed: u64,
}

/// Props with their films.
#[derive(Debug, Default)]
pub struct Coated {
    /// The props.
    pub props: Vec<Prop>,
    /// The props' films, fresh, one to one.
    pub films: Vec<FilmState>,
    /// Everything that was put right or left out.
    pub warnings: Vec<BakeWarning>,
}

/// Makes a fresh film for every mesh: the first step of [`bake`](super::bake()), for tools that do the ageing
/// themselves. Meshes that are all slivers, or of no possible size, are left out with a
/// warning, unless there is nothing else. `origin` is the
/// name of the input in messages.
///
/// ```
/// use bevy_coating::bake::{BakeOptions, Images, Input, coat};
///
/// let model = Input::parse("curved:80".as_ref())?.read(0, Images::Skip)?;
/// let options = BakeOptions::default();
/// let mut coated = coat(&model.origin, model.meshes, &options)?;
/// coated.films[0].step(&options.settings, &options.environment);
/// assert_eq!(coated.films[0].clock.steps, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BakeError::Options`] if an option is out of its range, [`BakeError::Build`] if no film can be made of a mesh,
/// [`BakeError::Broken`] if a film that came with a mesh is no
/// oriented manifold.
pub fn coat(origin: &str, meshes: Vec<ModelMesh>, options: &BakeOptions) -> Result<Coated, BakeError> {
    options.validate()?;
    let mut meshes = meshes;
    meshes.iter_mut().for_each(|mesh| into_metres(mesh, unit_of(mesh, options)));
    let areas: Vec<f64> = meshes.iter().map(|mesh| mesh.surface.area()).collect();
    let targets = film_targets(options.resolution, options.settings.scale.grain, &areas);
    let seeds = film_seeds(options.seed, &meshes);
    let mut jobs: Vec<Job> = meshes
        .into_iter()
        .zip(targets)
        .zip(seeds)
        .map(|((mesh, target), seed)| Job { unit: unit_of(&mesh, options), seed, mesh, target, result: None })
        .collect();
    parallel::for_each(&mut jobs, |job| job.run(options));

    let mut coated = Coated::default();
    let mut nothing = None;
    for Job { mesh, result, seed, unit, .. } in jobs {
        let ModelMesh { name, surface, origin: at, slots, place, .. } = mesh;
        let broken = |source| BakeError::Broken { origin: origin.into(), mesh: name.clone(), source };
        match result {
            Some(Ok((built, film))) => {
                let warnings = built.warnings.iter().cloned();
                coated.warnings.extend(warnings.map(|warning| BakeWarning::Build { mesh: name.clone(), warning }));
                coated.films.push(film.ok_or_else(|| broken(BrokenFilm::NotManifold))?);
                coated.props.push(Prop { name, surface, origin: at, metres_per_unit: unit, slots, place, built, seed });
            }
            Some(Err(
                source @ (BuildError::NoTriangles | BuildError::AllDegenerate { .. } | BuildError::Size { .. }),
            )) => {
                coated.warnings.push(BakeWarning::LeftOut { mesh: name.clone(), cause: source.clone() });
                nothing = Some(BakeError::Build { origin: origin.into(), mesh: name, source });
            }
            Some(Err(source)) => return Err(BakeError::Build { origin: origin.into(), mesh: name, source }),
            None => return Err(broken(BrokenFilm::NotBuilt)),
        }
    }
    match nothing {
        Some(error) if coated.films.is_empty() => Err(error),
        _ => Ok(coated),
    }
}

/// Returns the metres that a unit of the mesh is long. Films that come with their meshes are in metres.
fn unit_of(mesh: &ModelMesh, options: &BakeOptions) -> f32 {
    if mesh.film.is_some() { 1.0 } else { options.metres_per_unit }
}

/// Scales a mesh whose unit is `unit` metres long.
fn into_metres(mesh: &mut ModelMesh, unit: f32) {
    if unit == 1.0 {
        return;
    }
    mesh.surface.positions.iter_mut().for_each(|position| *position *= unit);
    mesh.origin *= unit;
    if let Some(place) = &mut mesh.place {
        place.transform = DMat4::from_scale(DVec3::splat(unit.into())) * place.transform;
    }
}

/// The build of one film.
struct Job {
    mesh: ModelMesh,
    target: FilmTarget,
    unit: f32,
    seed: u64,
    result: Option<Result<(BuiltFilm, Option<FilmState>), BuildError>>,
}

impl Job {
    fn run(&mut self, options: &BakeOptions) {
        let own = self.mesh.film.take();
        let is_own = own.is_some();
        let built = own.map_or_else(|| remesh::build_film(&self.mesh.surface, self.target, self.seed), Ok);
        self.result = Some(built.map(|mut built| {
            let mut film = FilmState::new(&built, &options.settings, self.seed, options.steps);
            if let Some(film) = &mut film {
                film.quality = options.quality;
                // The resolution is not that of a film that came with its mesh.
                let coarse = coarser_than_grain(&film.mesh, options.resolution, self.target, &options.settings.scale);
                built.warnings.extend(coarse.filter(|_| !is_own));
            }
            (built, film)
        }));
    }
}

/// Returns the seed of each film: that of the options, varied by the names of the meshes as the plugin varies a
/// coating's seed. One mesh alone is the prop itself, and has the seed of the options.
fn film_seeds(seed: u64, meshes: &[ModelMesh]) -> Vec<u64> {
    if let [_] = meshes {
        return vec![seed];
    }
    let mut seen: BTreeMap<&str, u32> = BTreeMap::new();
    let mut seed_of = |name| {
        let number = seen.entry(name).or_default();
        let step = PathStep { name, number: *number };
        *number += 1;
        film_seed(seed, &[step])
    };
    meshes.iter().map(|mesh| seed_of(mesh.name.as_str())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_of_equal_meshes_have_seeds_of_their_own() {
        let wheel = || ModelMesh { name: "wheel".into(), ..ModelMesh::default() };
        assert_eq!(film_seeds(7, &[wheel()]), [7]);
        let mut seeds = film_seeds(7, &[wheel(), wheel(), wheel(), wheel()]);
        assert_eq!(seeds, film_seeds(7, &[wheel(), wheel(), wheel(), wheel()]), "always the same");
        seeds.extend(film_seeds(8, &[wheel(), wheel()]));
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), 6);
    }
}
