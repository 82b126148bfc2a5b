//! Keeps what an appearance last saw of its film, and finds what is different.

pub(super) mod differences;
mod frames;
mod looks;
mod moves;

use super::changes::DisplayChanges;
use crate::{film::FilmMesh, fracture::FilmForces, stain::StainFields};
use differences::Differences;
use frames::Frames;
use looks::Looks;
use moves::Moves;

/// Film as it was last seen, and what has changed since.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    pub differences: Differences,
    pub moves: Moves,
    pub frames: Frames,
    pub looks: Looks,
    /// Whether anything moved or turned.
    pub moved: bool,
    /// Distance up to which a vertex may lie beside where it is shown, along each axis, in metres.
    tolerance: f32,
}

impl Seen {
    /// Returns what has seen nothing yet, and will overlook moves of up to `tolerance` metres.
    pub fn new(tolerance: f32) -> Self {
        Self { tolerance, ..Self::default() }
    }

    /// Compares the film, which has undergone `changes`, with what was seen. With `whole`, what was seen is void.
    pub fn follow(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        changes: DisplayChanges,
        whole: bool,
    ) {
        let Self { differences, moves, frames, looks, moved, tolerance } = self;
        if whole || changes.topology || changes.exposure {
            differences.look(mesh, forces, whole);
        } else {
            differences.clear();
        }
        *moved = false;
        if changes.moved || changes.topology || changes.exposure || differences.whole {
            let others = differences.vertices.iter().chain(&differences.separated);
            *moved = moves.follow(mesh, differences.whole, *tolerance, others.copied());
            if *moved {
                frames.follow(mesh, moves, differences);
            }
        } else {
            moves.clear();
        }
        looks.follow(mesh, stains, differences, changes.stains);
    }
}
