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
    masks::{CoatingMask, MaskError, MaskGround, apply_masks},
    remesh::{self, BuiltFilm, FilmTarget, film_targets},
    settings::{CoatingSettings, Preset},
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
    /// Seed of the film. A prop alone has the seed of the options, or that of its custom properties; of several props,
    /// each has one that follows from it and from the prop's name.
    pub seed: u64,
    /// Settings of the film: those of the options, or of the prop's custom properties.
    pub settings: CoatingSettings,
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
    if !options.extras {
        meshes.iter_mut().for_each(|mesh| mesh.extras = None);
    }
    let targets = targets(&meshes, &areas, options);
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
        let settings = settings_of(&mesh, options).clone();
        let ModelMesh { name, surface, origin: at, slots, place, .. } = mesh;
        let broken = |source| BakeError::Broken { origin: origin.into(), mesh: name.clone(), source };
        match result {
            Some(Ok((_, _, Err(source)))) => {
                return Err(BakeError::Mask { origin: origin.into(), mesh: name, source });
            }
            Some(Ok((built, film, Ok(())))) => {
                let warnings = built.warnings.iter().cloned();
                coated.warnings.extend(warnings.map(|warning| BakeWarning::Build { mesh: name.clone(), warning }));
                coated.films.push(film.ok_or_else(|| broken(BrokenFilm::NotManifold))?);
                let metres_per_unit = unit;
                coated.props.push(Prop {
                    name,
                    surface,
                    origin: at,
                    metres_per_unit,
                    slots,
                    place,
                    built,
                    seed,
                    settings,
                });
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
    result: Option<Result<(BuiltFilm, Option<FilmState>, Result<(), MaskError>), BuildError>>,
}

impl Job {
    fn run(&mut self, options: &BakeOptions) {
        let own = self.mesh.film.take();
        let is_own = own.is_some();
        let built = own.map_or_else(|| remesh::build_film(&self.mesh.surface, self.target, self.seed), Ok);
        self.result = Some(built.map(|mut built| {
            let settings = settings_of(&self.mesh, options);
            let mut film = FilmState::new(&built, settings, self.seed, options.steps);
            let mut masked = Ok(());
            if let Some(film) = &mut film {
                let (surface, gravity) = (&self.mesh.surface, options.environment.gravity);
                let ground = MaskGround { surface, built: &built, gravity, images: &options.mask_images };
                masked = apply_masks(film, &masks_of(&self.mesh, options), &ground);
                film.quality = options.quality;
                // The resolution is not that of a film that came with its mesh.
                let coarse = coarser_than_grain(&film.mesh, options.resolution, self.target, &settings.scale);
                built.warnings.extend(coarse.filter(|_| !is_own));
            }
            (built, film, masked)
        }));
    }
}

/// Returns the settings of a mesh: those of its custom properties, else of the options.
fn settings_of<'a>(mesh: &'a ModelMesh, options: &'a BakeOptions) -> &'a CoatingSettings {
    mesh.coating().map_or(&options.settings, |coating| &coating.settings)
}

/// Returns the masks of a mesh: those of the preset that its custom properties or the options name, and all of the
/// options.
fn masks_of(mesh: &ModelMesh, options: &BakeOptions) -> Vec<CoatingMask> {
    let preset = mesh.coating().map_or_else(|| options.preset.parse().ok(), |coating| Some(coating.preset));
    let mut masks = preset.map(Preset::masks).unwrap_or_default();
    masks.extend(options.masks.iter().cloned());
    masks
}

/// Returns the target of each film. Triangles are shared between all of them; each is as fine as its own grain asks.
fn targets(meshes: &[ModelMesh], areas: &[f64], options: &BakeOptions) -> Vec<FilmTarget> {
    let grain_of = |mesh| settings_of(mesh, options).scale.grain;
    let mut by_grain: BTreeMap<u32, Vec<FilmTarget>> = BTreeMap::new();
    let mut target = |i: usize, mesh| {
        let grain: f32 = grain_of(mesh);
        let shared = || film_targets(options.resolution, grain, areas);
        by_grain.entry(grain.to_bits()).or_insert_with(shared).get(i).copied().unwrap_or(FilmTarget::Keep)
    };
    meshes.iter().enumerate().map(|(i, mesh)| target(i, mesh)).collect()
}

/// Returns the seed of each film: that of its custom properties, else `seed`, varied by the names of the meshes as the
/// plugin varies a coating's seed. A mesh that shares its seed and paint with no other is the prop itself, and has the
/// seed as it is.
fn film_seeds(seed: u64, meshes: &[ModelMesh]) -> Vec<u64> {
    let own = |mesh: &ModelMesh| mesh.coating().and_then(|coating| coating.seed);
    let mut sharing: BTreeMap<u64, usize> = BTreeMap::new();
    meshes.iter().filter_map(own).for_each(|seed| *sharing.entry(seed).or_default() += 1);
    let mut seen: BTreeMap<(Option<u64>, &str), u32> = BTreeMap::new();
    let seed_of = |mesh| {
        let own = own(mesh);
        let base = own.unwrap_or(seed);
        let alone = own.map_or(meshes.len(), |seed| sharing.get(&seed).copied().unwrap_or_default()) == 1;
        let name = mesh.name.as_str();
        let number = seen.entry((own, name)).or_default();
        let step = PathStep { name, number: *number };
        *number += 1;
        if alone { base } else { film_seed(base, &[step]) }
    };
    meshes.iter().map(seed_of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extras::PropExtras;

    #[test]
    fn seeds_of_custom_properties_go_before_that_of_the_options() {
        let mesh = |name: &str, seed| ModelMesh {
            name: name.into(),
            extras: PropExtras::read(&format!(r#"{{ "coating": true, "coating_seed": {seed} }}"#)).expect("extras"),
            ..ModelMesh::default()
        };
        let plain = ModelMesh { name: "plain".into(), ..ModelMesh::default() };
        let seeds = film_seeds(7, &[mesh("a", 3), plain.clone(), mesh("b", 4), mesh("c", 4)]);
        assert_eq!(seeds[0], 3, "it is alone with its seed");
        assert_eq!(seeds[1], film_seeds(7, &[plain.clone(), mesh("a", 3)])[0]);
        assert!(seeds[2] != seeds[3] && ![4, 7].contains(&seeds[2]), "{seeds:?}");
    }

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
