//! Does a touch to a film.

use super::{
    effect::{Effect, Touch, TouchError},
    fields::{change_adhesion, change_binding, change_contraction, change_stains, faces_to_renew, faces_under},
    reach::Reach,
    route::route,
};
use crate::{
    film::{FaceId, FilmChanges},
    fracture::{cut, cut_out, strike},
    settings::CoatingSettings,
    sim::{
        FilmState,
        edit::{FilmParts, Renewed, edit},
    },
    stain::Environment,
};

/// Outcome of a touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Touched {
    /// Damage that was done, in the form of a step's changes.
    pub changes: FilmChanges,
    /// Whether there is new paint ([`Effect::Repaint`]).
    pub repainted: bool,
    /// Whether edges or faces are whole for it that were not, so that faces may have other vertices than before. It is
    /// not where nothing was torn.
    pub renewed: bool,
}

/// Touches a film between two steps. `settings` and `environment` are those under which it ages.
///
/// The time is proportional to what the touch reaches, breaks and mends, and to a short pass over the faces of the
/// film. But [`Effect::Scratch`] looks at all edges (1 ms for 10,000 faces), and [`Effect::Repaint`] puts the whole
/// film together again where more than half of it is new, or painting has left many vertices without faces: 6 to 20 ms.
///
/// # Errors
/// [`TouchError`], with the film as it was, if a number of the touch is out of range or the film has no such face.
///
/// See the [module](super) for an example.
pub fn touch(
    mut parts: FilmParts,
    settings: &CoatingSettings,
    environment: &Environment,
    touch: &Touch,
) -> Result<Touched, TouchError> {
    touch.check()?;
    let faces = parts.mesh.topology.face_count();
    let sites = match touch.effect {
        Effect::Scratch(to) => [touch.site, to],
        _ => [touch.site; 2],
    };
    if let Some(site) = sites.into_iter().find(|site| site.face.index() >= faces) {
        return Err(TouchError::NoFace { face: site.face.0, faces });
    }
    let reach = Reach::new(parts.mesh, touch.site, touch.radius);
    let mut touched = Touched::default();
    match touch.effect {
        Effect::Adhesion(by) => change_adhesion(&mut parts, touch, &reach, by),
        Effect::Binding(by) => change_binding(&mut parts, touch, &reach, by),
        Effect::Contraction(by) => change_contraction(&mut parts, touch, &reach, by),
        Effect::Rust(layers) => change_stains(&mut parts, touch, &reach, |stain, strength| {
            stain.wet += layers * strength;
        }),
        Effect::Dust(by) => change_stains(&mut parts, touch, &reach, |stain, strength| stain.change_dust(by, strength)),
        Effect::Moisture(by) => {
            change_stains(&mut parts, touch, &reach, |stain, strength| stain.change_moisture(by, strength));
        }
        Effect::Wash(share) => change_stains(&mut parts, touch, &reach, |stain, strength| stain.wash(share * strength)),
        Effect::Sand(share) => {
            change_stains(&mut parts, touch, &reach, |stain, strength| stain.sand(share * strength));
            let loose = if share > 0.0 { loose_under(&parts, touch, &reach) } else { Vec::new() };
            strip(parts, settings, environment, &loose, &mut touched.changes);
        }
        Effect::Strip => {
            let faces = faces_under(&parts.mesh.topology, touch, &reach);
            strip(parts, settings, environment, &faces, &mut touched.changes);
        }
        Effect::Repaint => {
            let faces = faces_to_renew(&parts.mesh.topology, touch, &reach);
            let renewed = parts.renew(settings, environment, faces);
            touched.repainted = renewed != Renewed::No;
            touched.renewed = matches!(renewed, Renewed::Mended | Renewed::Whole);
            if let Renewed::InPlace(attached) = renewed {
                touched.changes.moved = !attached.is_empty();
                touched.changes.attached = attached;
            }
        }
        Effect::Hit(force) => {
            let blow: Vec<f32> = reach.distances.iter().map(|&d| force * touch.strength(d)).collect();
            edit(parts, settings, environment, &mut touched.changes, |parts, changes| {
                let age = parts.clock.age() as f32;
                let FilmParts { mesh, forces, scratch, .. } = parts;
                let (gravity, scratch) = (environment.gravity, &mut scratch.fracture);
                strike(mesh, forces, settings, gravity, age, &blow, &reach.faces, changes, scratch)
            });
        }
        Effect::Scratch(to) => {
            let edges = route(parts.mesh, touch.site, to);
            edit(parts, settings, environment, &mut touched.changes, |parts, changes| {
                let age = parts.clock.age() as f32;
                let FilmParts { mesh, forces, scratch, .. } = parts;
                let (gravity, scratch) = (environment.gravity, &mut scratch.fracture);
                cut(mesh, forces, settings, gravity, age, &edges, changes, scratch)
            });
        }
    }
    Ok(touched)
}

/// Takes `faces` off.
fn strip(
    parts: FilmParts,
    settings: &CoatingSettings,
    environment: &Environment,
    faces: &[FaceId],
    changes: &mut FilmChanges,
) {
    edit(parts, settings, environment, changes, |parts, changes| {
        let age = parts.clock.age() as f32;
        let FilmParts { mesh, forces, scratch, .. } = parts;
        cut_out(mesh, forces, settings, environment.gravity, age, faces, changes, &mut scratch.fracture)
    });
}

/// Returns the faces under the touch of which no corner is attached.
fn loose_under(parts: &FilmParts, touch: &Touch, reach: &Reach) -> Vec<FaceId> {
    let topology = &parts.mesh.topology;
    let is_loose =
        |f: &FaceId| topology.is_live(*f) && !topology.corners(*f).into_iter().any(|v| parts.forces.is_attached(v));
    faces_under(topology, touch, reach).into_iter().filter(is_loose).collect()
}

impl FilmState {
    /// Touches the film between two steps: see [`touch`]. Returns [`Touched::renewed`]. What broke, and what new paint
    /// attached again, is appended to [`FilmState::changes`].
    ///
    /// # Errors
    /// [`TouchError`], with the film as it was, if a number of the touch is out of range or the film has no such face.
    pub fn touch(
        &mut self,
        with: &Touch,
        settings: &CoatingSettings,
        environment: &Environment,
    ) -> Result<bool, TouchError> {
        let Touched { changes, renewed, .. } = touch(self.parts(), settings, environment, with)?;
        self.changes.append(changes);
        Ok(renewed)
    }
}
