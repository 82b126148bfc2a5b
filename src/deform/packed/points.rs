//! The points of a film in the packed solver: where they are, and which of them move.

mod saved;

use bevy_math::{Vec3, Vec4};

use super::{
    layout::Layout,
    level::Kernels,
    point::{Point, PointOffset},
};
use crate::film::words::Words;

/// Stands where there is no vertex.
const NO_VERTEX: u32 = u32::MAX;
/// Number of vertices of a region for each duplicate that it has room for. More of them lie behind all regions.
const ROOM: usize = 4;
/// Widest group of points that a kernel takes.
const GROUP: usize = 32;

/// Motion of a vertex: what the solver does with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Held by the metal.
    Attached,
    /// Free, but left out as it moves too little to be seen: others see it as fixed.
    Asleep,
    /// Free, and moving.
    Awake,
    /// Without faces, as they are all removed.
    Gone,
}

/// Points of a film. Point 0 is the null point that unused lanes refer to; the others lie region by region, with
/// room for duplicates.
///
/// Positions are in units of a power of two near the film's mean edge: products of many lengths then neither overflow
/// nor vanish, and turning them back loses no bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    unit: f32,
    /// Offset of each vertex's point.
    offsets: Vec<PointOffset>,
    /// Vertex of each point; [`NO_VERTEX`] for the null point and for room.
    vertices: Vec<u32>,
    /// Room that is left in each region: points from the first to before the second.
    room: Vec<[u32; 2]>,
    now: Vec<Point>,
    /// Place of each point before the last sweep, from which its momentum comes.
    before: Vec<Point>,
    /// Plane of each point at rest, below which it does not go (VC 5).
    planes: Vec<Point>,
    motions: Vec<Motion>,
    /// Region of each vertex.
    region_of: Vec<u16>,
    /// Awake points of each region.
    awake: Vec<Awake>,
    /// Number of vertices that sleep.
    asleep: usize,
}

/// Awake points of a region.
#[derive(Clone, Debug, Default, PartialEq)]
struct Awake {
    /// Offsets, padded with the null point to whole groups. In the order of memory, but for those that woke since the
    /// last tick.
    offsets: Vec<PointOffset>,
    count: usize,
    sorted: bool,
}

impl Awake {
    fn push(&mut self, offset: PointOffset) {
        self.offsets.truncate(self.count);
        self.offsets.push(offset);
        self.count += 1;
        self.sorted = false;
        self.pad();
    }

    fn pad(&mut self) {
        self.offsets.truncate(self.count);
        self.offsets.resize(self.count.next_multiple_of(GROUP), PointOffset::NULL);
    }
}

impl Points {
    /// Makes the points of vertices at `rest` with their normals, all attached. `mean_edge` is in the unit of `rest`.
    pub fn new(rest: &[Vec3], normals: &[Vec3], mean_edge: f32, layout: &Layout) -> Self {
        // The exponent alone; 1 for films without extent.
        let unit = f32::from_bits(mean_edge.to_bits() & 0x7f80_0000);
        let unit = if unit.is_normal() && (1.0 / unit).is_normal() { unit } else { 1.0 };
        let mut points = Self {
            unit,
            offsets: vec![PointOffset::NULL; rest.len()],
            motions: vec![Motion::Attached; rest.len()],
            room: vec![[0; 2]; layout.regions],
            region_of: layout.region_of.clone(),
            awake: vec![Awake::default(); layout.regions],
            ..Self::default()
        };
        points.push(NO_VERTEX, Point::default(), Point::default());
        for region in layout.order.chunk_by(|&a, &b| layout.region_of[a as usize] == layout.region_of[b as usize]) {
            for &v in region {
                let i = v as usize;
                let (p, n) = (rest[i] / unit, normals[i]);
                points.offsets[i] =
                    points.push(v, Point(p.extend(0.0).to_array()), Point(n.extend(n.dot(p)).to_array()));
            }
            let first = points.now.len() as u32;
            let room = (region.len() / ROOM) as u32;
            points.room[layout.region_of[region[0] as usize] as usize] = [first, first + room];
            for _ in 0..room {
                points.push(NO_VERTEX, Point::default(), Point::default());
            }
        }
        points
    }

    fn push(&mut self, vertex: u32, at: Point, plane: Point) -> PointOffset {
        self.vertices.push(vertex);
        self.now.push(at);
        self.before.push(at);
        self.planes.push(plane);
        PointOffset::new(self.now.len() - 1)
    }

    /// Returns the offset of vertex `v`, or that of the null point if there is no such vertex, so that the kernels may
    /// trust every offset.
    pub fn offset(&self, v: u32) -> PointOffset {
        self.offsets.get(v as usize).copied().unwrap_or(PointOffset::NULL)
    }

    /// Returns the vertex at `offset`; no vertex's index (`u32::MAX`) for the null point.
    pub fn vertex(&self, offset: PointOffset) -> usize {
        self.vertices[offset.index()] as usize
    }

    /// Returns what the vertex at `offset` does; the null point is attached.
    pub fn motion_at(&self, offset: PointOffset) -> Motion {
        self.motions.get(self.vertex(offset)).copied().unwrap_or(Motion::Attached)
    }

    /// Returns the number of vertices.
    pub fn len(&self) -> usize {
        self.motions.len()
    }

    /// Returns the length of the points' unit, in the film's unit.
    pub fn unit(&self) -> f32 {
        self.unit
    }

    /// Returns what vertex `v` does.
    #[inline]
    pub fn motion(&self, v: usize) -> Motion {
        self.motions[v]
    }

    /// Returns the position of vertex `v`, in the film's unit.
    #[inline]
    pub fn position(&self, v: usize) -> Vec3 {
        xyz(self.now[self.offsets[v].index()]) * self.unit
    }

    /// Returns the region of vertex `v`. A duplicate is in the region of its vertex.
    #[inline]
    pub fn region_of(&self, v: usize) -> usize {
        self.region_of[v] as usize
    }

    /// Returns the vertices that are awake, region by region.
    pub fn awake(&self) -> impl Iterator<Item = usize> + '_ {
        self.awake.iter().flat_map(|awake| &awake.offsets[..awake.count]).map(|&offset| self.vertex(offset))
    }

    /// Returns the number of awake vertices.
    pub fn awake_count(&self) -> usize {
        self.awake.iter().map(|awake| awake.count).sum()
    }

    /// Returns the number of vertices that sleep.
    pub fn asleep_count(&self) -> usize {
        self.asleep
    }

    /// Appends a duplicate of vertex `kept`.
    pub fn duplicate(&mut self, kept: usize) {
        let region = self.region_of(kept);
        self.region_of.push(region as u16);
        let from = self.offsets[kept].index();
        let (at, before, plane) = (self.now[from], self.before[from], self.planes[from]);
        let v = self.offsets.len();
        let [next, end] = &mut self.room[region];
        let offset = if next < end {
            *next += 1;
            PointOffset::new(*next as usize - 1)
        } else {
            self.push(NO_VERTEX, at, plane)
        };
        let i = offset.index();
        (self.now[i], self.before[i], self.planes[i], self.vertices[i]) = (at, before, plane, v as u32);
        self.offsets.push(offset);
        if self.motions[kept] == Motion::Awake {
            self.motions.push(Motion::Attached);
            self.wake(v);
        } else {
            self.motions.push(self.motions[kept]);
            self.asleep += usize::from(self.motions[kept] == Motion::Asleep);
        }
    }

    /// Wakes vertex `v`, unless it is awake. It has no momentum, or that of its vertex if it is a duplicate.
    pub fn wake(&mut self, v: usize) {
        if self.motions[v] == Motion::Awake {
            return;
        }
        self.asleep -= usize::from(self.motions[v] == Motion::Asleep);
        self.motions[v] = Motion::Awake;
        let offset = self.offsets[v];
        self.now[offset.index()].0[3] = 1.0;
        self.awake[self.region_of[v] as usize].push(offset);
    }

    /// Puts vertex `v` to sleep; to be followed by [`Self::settle`].
    pub fn sleep(&mut self, v: usize) {
        self.asleep += usize::from(self.motions[v] != Motion::Asleep);
        self.motions[v] = Motion::Asleep;
    }

    /// Marks vertex `v` as gone, as it has no faces left; to be followed by [`Self::settle`].
    pub fn leave(&mut self, v: usize) {
        self.asleep -= usize::from(self.motions[v] == Motion::Asleep);
        self.motions[v] = Motion::Gone;
    }

    /// Has the metal hold vertex `v` again; to be followed by [`Self::settle`].
    pub fn hold(&mut self, v: usize) {
        self.asleep -= usize::from(self.motions[v] == Motion::Asleep);
        self.motions[v] = Motion::Attached;
    }

    /// Puts vertex `to` where `from` is, with its momentum.
    pub fn put_like(&mut self, to: usize, from: usize) {
        let (to, from) = (self.offsets[to].index(), self.offsets[from].index());
        for list in [&mut self.now, &mut self.before] {
            let Point([x, y, z, _]) = list[from];
            let mass = list[to].0[3];
            list[to] = Point([x, y, z, mass]);
        }
    }

    /// Brings the lists of awake points into the order of memory. What is done to each is the same in any order.
    pub fn sort(&mut self) {
        for awake in self.awake.iter_mut().filter(|awake| !awake.sorted) {
            awake.offsets[..awake.count].sort_unstable();
            awake.sorted = true;
        }
    }

    /// Takes the vertices that no longer move off the lists of awake ones, and their momentum from them.
    pub fn settle(&mut self) {
        let Self { now, before, motions, vertices, awake, .. } = self;
        for awake in awake {
            let mut kept = 0;
            for i in 0..awake.count {
                let offset = awake.offsets[i];
                if motions[vertices[offset.index()] as usize] == Motion::Awake {
                    awake.offsets[kept] = offset;
                    kept += 1;
                } else {
                    let point = &mut now[offset.index()];
                    point.0[3] = 0.0;
                    before[offset.index()] = *point;
                }
            }
            awake.count = kept;
            awake.pad();
        }
    }

    /// Puts vertex `v` to `position`, as if it had been at `before` before the last sweep; both in the film's unit.
    pub fn put(&mut self, v: usize, position: Vec3, before: Vec3) {
        let scale = 1.0 / self.unit;
        let i = self.offsets[v].index();
        let mass = self.now[i].0[3];
        self.now[i] = Point((position * scale).extend(mass).to_array());
        self.before[i] = Point((before * scale).extend(mass).to_array());
    }

    /// Returns where vertex `v` was before the last sweep, in the film's unit.
    pub fn position_before(&self, v: usize) -> Vec3 {
        xyz(self.before[self.offsets[v].index()]) * self.unit
    }

    /// Writes the positions of awake vertices into `positions`, in the film's unit.
    pub fn write_awake(&self, positions: &mut [Vec3]) {
        for v in self.awake() {
            positions[v] = self.position(v);
        }
    }

    /// Moves the awake points of a region on by `keep` of what they moved in the last sweep (momentum), and lifts those
    /// below their planes onto them.
    pub fn advance(&mut self, kernels: &Kernels, region: usize, keep: f32) {
        let offsets = &self.awake[region].offsets;
        // SAFETY: kernels are those of this CPU, and awake points exist.
        unsafe {
            let (now, before) = (self.now.as_mut_ptr(), self.before.as_mut_ptr());
            (kernels.advance)(now, before, self.planes.as_ptr(), offsets, keep);
        }
    }

    /// Lifts the awake points of a region that are below their planes onto them (VC 5).
    pub fn project(&mut self, kernels: &Kernels, region: usize) {
        // SAFETY: as above.
        unsafe { (kernels.project)(self.now.as_mut_ptr(), self.planes.as_ptr(), &self.awake[region].offsets) }
    }

    /// Appends all that decides where points go.
    pub fn write_state(&self, to: &mut Words) {
        // Planes follow from the film at rest, and the number of sleepers from the motions.
        let Self { unit, offsets, vertices, room, now, before, planes: _, motions, region_of, awake, asleep: _ } = self;
        to.float(*unit);
        to.list(offsets.iter().map(|offset| offset.index() as u32));
        to.list(vertices.iter().copied());
        to.list(room.as_flattened().iter().copied());
        to.fours(now.iter().map(|point| Vec4::from_array(point.0)));
        to.fours(before.iter().map(|point| Vec4::from_array(point.0)));
        to.list(motions.iter().map(|&motion| motion as u32));
        to.list(region_of.iter().map(|&region| u32::from(region)));
        for awake in awake {
            to.list(awake.offsets.iter().take(awake.count).map(|offset| offset.index() as u32));
        }
    }

    /// Returns the points, for the sweeps.
    pub fn now_mut(&mut self) -> &mut [Point] {
        &mut self.now
    }
}

fn xyz(Point([x, y, z, _]): Point) -> Vec3 {
    Vec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_points_counts() {
        let rest = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let points = Points::new(&rest, &[Vec3::Z; 3], 1.0, &Layout::new(&rest));
        let changes: [fn(&mut Points); 9] = [
            |points| points.unit = 2.0,
            |points| points.offsets.swap(0, 1),
            |points| points.vertices.swap(1, 2),
            |points| points.room[0][0] += 1,
            |points| points.now[1].0[2] = 0.5,
            |points| points.before[1].0[2] = 0.5,
            |points| points.motions[0] = Motion::Asleep,
            |points| points.region_of[0] = 1,
            |points| points.awake[0].push(PointOffset::new(2)),
        ];
        assert_each_counts(&points, Points::write_state, &changes);
    }
}
