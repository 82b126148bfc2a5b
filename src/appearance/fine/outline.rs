//! Shapes the outlines of faces: where edges have torn, the points of a face's grid follow the chips.

use bevy_math::{Vec3, Vec3A};

use super::{
    base::{Base, Place},
    chips::Chip,
    lanes::{LANES, Lanes, Places, collect},
    patch::{Patch, weights},
};
use crate::film::{FaceId, FilmMesh, HalfEdgeId};

/// Entry of a face whose outline is straight.
const STRAIGHT: u32 = u32::MAX;

/// Where the points of each face's grid lie on the film, now that edges have torn.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    /// Largest amplitude of chips, in metres.
    amplitude: f32,
    /// Which edges of each face have torn: one bit each.
    torn: Vec<u8>,
    /// Block of `chipped` that a face has, or [`STRAIGHT`].
    block: Vec<u32>,
    /// Where the points of chipped faces lie.
    chipped: Vec<Places>,
    /// Blocks of `chipped` that no face has any more.
    free: Vec<u32>,
    /// Offset of each point of each face from the patch at rest, eight in each entry.
    offsets: Vec<[Lanes; 3]>,
}

impl Outlines {
    /// Returns the outlines of a film without cracks.
    pub fn new(mesh: &FilmMesh, base: &Base, amplitude: f32) -> Self {
        let faces = mesh.topology.face_count();
        let mut offsets = Vec::with_capacity(faces * base.places.len());
        for f in mesh.topology.all_faces() {
            let patch = rest_patch(mesh, f);
            let points = base.positions[base.index(f, 0)..base.index(f, base.points)].chunks(LANES);
            let offset = |(&at, &b): (&Vec3, &Vec3)| (Vec3A::from(at) - patch.at(&weights(b))).to_array();
            let all = points.zip(base.grid.points().chunks(LANES));
            offsets.extend(all.map(|(points, b)| collect(points.iter().zip(b).map(offset))));
        }
        Self { amplitude, torn: vec![0; faces], block: vec![STRAIGHT; faces], offsets, ..Self::default() }
    }

    /// Returns whether other edges of `f` have torn than when this was last called for it.
    pub fn has_torn(&mut self, mesh: &FilmMesh, f: FaceId) -> bool {
        let torn =
            f.half_edges().iter().enumerate().fold(0, |bits, (k, &h)| bits | u8::from(mesh.topology.is_torn(h)) << k);
        std::mem::replace(&mut self.torn[f.index()], torn) != torn
    }

    /// Shapes the outline of `f` again, and calls `put` with each of its points and what lies there at rest.
    pub fn shape(&mut self, mesh: &FilmMesh, base: &Base, f: FaceId, mut put: impl FnMut(usize, Place)) {
        let chips = self.chips(mesh, f);
        let block = self.block[f.index()];
        if chips.iter().all(Option::is_none) {
            if block != STRAIGHT {
                self.straighten(mesh, base, f, put);
            }
            return;
        }
        if block == STRAIGHT {
            self.block[f.index()] = self.free.pop().unwrap_or_else(|| {
                self.chipped.extend_from_slice(&base.places);
                (self.chipped.len() / base.places.len() - 1) as u32
            });
        }
        let first = self.block[f.index()] as usize * base.places.len();
        let patch = rest_patch(mesh, f);
        for (i, &b) in base.grid.points().iter().enumerate() {
            let shifted = b + shift(&chips, b);
            let mut place = base.at(f, shifted);
            if let Some(on_edge) = self.place_on_crack(mesh, base, f, &chips, b) {
                place.position = on_edge;
            }
            self.set_offset(base, f, i, Vec3A::from(place.position) - patch.at(&weights(shifted)));
            self.chipped[first + i / LANES].set(i % LANES, shifted);
            put(i, place);
        }
    }

    /// Takes the chips of `f` back, as when its film goes back in time.
    fn straighten(&mut self, mesh: &FilmMesh, base: &Base, f: FaceId, mut put: impl FnMut(usize, Place)) {
        self.free.push(std::mem::replace(&mut self.block[f.index()], STRAIGHT));
        let patch = rest_patch(mesh, f);
        for (i, &b) in base.grid.points().iter().enumerate() {
            let place = base.of(f, i);
            self.set_offset(base, f, i, Vec3A::from(place.position) - patch.at(&weights(b)));
            put(i, place);
        }
    }

    fn set_offset(&mut self, base: &Base, f: FaceId, i: usize, offset: Vec3A) {
        let lanes = &mut self.offsets[f.index() * base.places.len() + i / LANES];
        for (lanes, x) in lanes.iter_mut().zip(offset.to_array()) {
            lanes[i % LANES] = x;
        }
    }

    /// Returns where the points of `f` lie on it.
    #[inline]
    pub fn places<'a>(&'a self, base: &'a Base, f: FaceId) -> &'a [Places] {
        let (block, count) = (self.block[f.index()], base.places.len());
        if block == STRAIGHT { &base.places } else { &self.chipped[block as usize * count..][..count] }
    }

    /// Returns the offsets of the points of `f` from the patch at rest.
    #[inline]
    pub fn offsets(&self, base: &Base, f: FaceId) -> &[[Lanes; 3]] {
        &self.offsets[f.index() * base.places.len()..][..base.places.len()]
    }

    fn chips(&self, mesh: &FilmMesh, f: FaceId) -> [Option<Chip>; 3] {
        f.half_edges().map(|h| Chip::of(mesh, h, self.amplitude))
    }

    /// Returns the rest position of the point `b` of `f` if it lies on a chipped edge. Both faces at the edge get the
    /// same bits: the position on the face into which the curve leads there.
    fn place_on_crack(
        &self,
        mesh: &FilmMesh,
        base: &Base,
        f: FaceId,
        chips: &[Option<Chip>; 3],
        b: Vec3,
    ) -> Option<Vec3> {
        // Half-edge k lies opposite corner k + 2. The corners themselves stay.
        let k = (0..3).find(|&k| b[(k + 2) % 3] == 0.0 && b[k] > 0.0 && b[(k + 1) % 3] > 0.0)?;
        let chip = chips[k].as_ref()?;
        let h = HalfEdgeId(f.0 * 3 + k as u32);
        if chip.shift(b) >= 0.0 {
            return Some(base.at(f, b + shift(chips, b)).position);
        }
        let twin = mesh.topology.rest_twin(h)?;
        let (other, j) = (twin.face(), twin.index() % 3);
        let mut there = Vec3::ZERO;
        there[j] = b[(k + 1) % 3];
        there[(j + 1) % 3] = b[k];
        // The other edges of that face do not shift points of this one.
        let chip = Chip::of(mesh, twin, self.amplitude)?;
        Some(base.at(other, there + chip.moved(chip.shift(there))).position)
    }
}

/// Returns the change of the barycentric coordinates `b` by all chips of a face.
fn shift(chips: &[Option<Chip>; 3], b: Vec3) -> Vec3 {
    chips.iter().flatten().fold(Vec3::ZERO, |sum, chip| sum + chip.moved(chip.shift(b)))
}

/// Returns the patch over `f` at rest.
pub(super) fn rest_patch(mesh: &FilmMesh, f: FaceId) -> Patch {
    let originals = mesh.topology.corners(f).map(|v| mesh.topology.original(v).index());
    Patch::new(
        originals.map(|v| mesh.geometry.rest_positions[v].into()),
        originals.map(|v| mesh.geometry.rest_normals[v].into()),
    )
}
