//! Shapes the outlines of faces: where edges have torn, the points of a face's grid follow the chips.

use bevy_math::{Vec3, Vec3A};

use super::{
    base::{Base, Place},
    chips::Chip,
    patch::{Patch, weights},
    view::View,
};
use crate::film::{FaceId, FilmMesh, HalfEdgeId};

/// Entry of what is not chipped.
const STRAIGHT: u32 = u32::MAX;

/// Where the points of chipped faces lie on them.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    /// Largest amplitude of chips, in metres.
    amplitude: f32,
    /// Which edges of each face have torn: one bit each.
    torn: Vec<u8>,
    edges: Shifted,
    insides: Shifted,
}

/// Barycentric coordinates of the points of edges or faces that chips have shifted.
#[derive(Clone, Debug, Default)]
struct Shifted {
    /// Number of points of each.
    count: usize,
    /// Block of `places` that each has, or [`STRAIGHT`].
    of: Vec<u32>,
    places: Vec<Vec3>,
}

/// A point that was shifted: where on its face it is, and what lies there at rest.
pub(super) struct ShapedPoint {
    /// Half-edge on which it lies; `None` for a point inside.
    pub edge: Option<HalfEdgeId>,
    /// Which of the points of the edge, or inside, it is.
    pub i: usize,
    pub place: Place,
    /// Offset of the place from the patch at rest.
    pub offset: Vec3A,
}

impl Outlines {
    /// Returns outlines with chips of an amplitude of up to `amplitude` metres.
    pub fn new(amplitude: f32) -> Self {
        Self { amplitude, ..Self::default() }
    }

    /// Makes all outlines straight.
    pub fn clear(&mut self, mesh: &FilmMesh, base: &Base) {
        let (topology, layout) = (&mesh.topology, &base.layout);
        self.torn.clear();
        self.torn.resize(topology.face_count(), 0);
        self.edges.clear(layout.edge_points(), topology.half_edge_count());
        self.insides.clear(layout.inner_points(), topology.face_count());
    }

    /// Returns whether other edges of `f` have torn than when this was last called for it.
    pub fn has_torn(&mut self, mesh: &FilmMesh, f: FaceId) -> bool {
        let torn =
            f.half_edges().iter().enumerate().fold(0, |bits, (k, &h)| bits | u8::from(mesh.topology.is_torn(h)) << k);
        std::mem::replace(&mut self.torn[f.index()], torn) != torn
    }

    /// Shapes the outline of `f` again, and calls `put` with each point that chips shift: those on chipped edges and
    /// those inside.
    pub fn shape(&mut self, view: &View, f: FaceId, mut put: impl FnMut(ShapedPoint)) {
        let layout = &view.base.layout;
        let chips = f.half_edges().map(|h| Chip::of(view.mesh, h, self.amplitude));
        if chips.iter().all(Option::is_none) {
            return;
        }
        let patch = rest_patch(view, f);
        let mut shape = |edge: Option<HalfEdgeId>, i: usize, shifted: Vec3, place: Place| {
            let offset = Vec3A::from(place.position) - patch.at(&weights(shifted));
            put(ShapedPoint { edge, i, place, offset });
        };
        for ((h, chip), points) in f.half_edges().into_iter().zip(&chips).zip(&layout.edges) {
            let Some(chip) = chip else { continue };
            for (i, (to, &b)) in self.edges.shift(h.index()).iter_mut().zip(points).enumerate() {
                // Chips of the other edges end at the corners.
                let distance = chip.shift(b);
                *to = b + chip.moved(distance);
                let mut place = view.base.at(f, *to);
                if distance < 0.0
                    && let Some(position) = other_side(view, h, b, self.amplitude)
                {
                    place.position = position;
                }
                shape(Some(h), i, *to, place);
            }
        }
        for (i, (to, spot)) in self.insides.shift(f.index()).iter_mut().zip(&layout.inside).enumerate() {
            *to = chips.iter().flatten().fold(spot.b, |sum, chip| sum + chip.moved(chip.shift(spot.b)));
            shape(None, i, *to, view.base.at(f, *to));
        }
    }

    /// Returns where the points of the edge of `h` lie on its face, if it is chipped.
    #[inline]
    pub fn edge(&self, h: HalfEdgeId) -> Option<&[Vec3]> {
        if self.is_whole(h.face()) { None } else { self.edges.get(h.index()) }
    }

    /// Returns where the points inside `f` lie, if it is chipped.
    #[inline]
    pub fn inside(&self, f: FaceId) -> Option<&[Vec3]> {
        if self.is_whole(f) { None } else { self.insides.get(f.index()) }
    }

    /// Returns whether no edge of `f` has torn.
    #[inline]
    fn is_whole(&self, f: FaceId) -> bool {
        self.torn[f.index()] == 0
    }
}

impl Shifted {
    fn clear(&mut self, count: usize, keys: usize) {
        self.count = count;
        self.of.clear();
        self.of.resize(keys, STRAIGHT);
        self.places.clear();
    }

    #[inline]
    fn get(&self, key: usize) -> Option<&[Vec3]> {
        let block = self.of[key];
        (block != STRAIGHT).then(|| &self.places[block as usize * self.count..][..self.count])
    }

    /// Returns the places of `key`, to be written.
    fn shift(&mut self, key: usize) -> &mut [Vec3] {
        if self.of[key] == STRAIGHT {
            // Where there are no points, all have the same block.
            self.of[key] = self.places.len().checked_div(self.count).unwrap_or(0) as u32;
            self.places.resize(self.places.len() + self.count, Vec3::ZERO);
        }
        &mut self.places[self.of[key] as usize * self.count..][..self.count]
    }
}

/// Returns the rest position of the point `b` on the edge of `h` where the chip leads into the face at the other side.
/// Both faces at the edge get the same bits: the position on the face into which the curve leads there.
fn other_side(view: &View, h: HalfEdgeId, b: Vec3, amplitude: f32) -> Option<Vec3> {
    let twin = view.topology().rest_twin(h)?;
    let (k, j) = (h.index() % 3, twin.index() % 3);
    let mut there = Vec3::ZERO;
    there[j] = b[(k + 1) % 3];
    there[(j + 1) % 3] = b[k];
    let chip = Chip::of(view.mesh, twin, amplitude)?;
    Some(view.base.at(twin.face(), there + chip.moved(chip.shift(there))).position)
}

/// Returns the patch over `f` at rest.
pub(super) fn rest_patch(view: &View, f: FaceId) -> Patch {
    let (positions, normals) = view.at_rest(view.topology().corners(f));
    Patch::new(positions, normals)
}
