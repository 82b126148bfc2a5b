//! Points of the packed solver: 16 bytes each, so that one load brings all there is.

use bevy_math::Vec3;

use super::{
    Region,
    level::{Kernels, SimdLevel},
};
use crate::deform::regions::Layout;

/// Position (x, y, z) and inverse mass of a point; or unit normal and distance from the origin of a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(16))]
pub struct Point(pub(super) [f32; 4]);

/// Where a point lies: its offset in bytes, as scaling an index by 16 costs an instruction each time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(transparent)]
pub(super) struct PointOffset(u32);

impl PointOffset {
    /// Of the null point.
    pub const NULL: Self = Self(0);

    /// Of the point at `index`. Films have far fewer points than the 2^28 that fit.
    pub(super) fn new(index: usize) -> Self {
        Self(index as u32 * 16)
    }

    /// The point here. Wrapping, as the check that others make in debug builds would cost more than the rest; within the
    /// points it is the same.
    #[inline(always)]
    pub fn of(self, points: *const Point) -> *const Point {
        points.wrapping_byte_add(self.0 as usize)
    }

    /// The same, to be written.
    #[inline(always)]
    pub fn of_mut(self, points: *mut Point) -> *mut Point {
        points.wrapping_byte_add(self.0 as usize)
    }

    #[inline(always)]
    fn index(self) -> usize {
        (self.0 / 16) as usize
    }
}

/// No vertex.
const NO_VERTEX: u32 = u32::MAX;
/// A region has room for one duplicate in so many vertices. More of them lie behind all regions.
const ROOM: usize = 4;
/// Widest group of points that a kernel takes.
const GROUP: usize = 32;

/// What a vertex does in the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It holds on to the metal.
    Attached,
    /// It is free, but moves too little to be looked at: others see it as fixed.
    Asleep,
    /// It moves.
    Awake,
    /// None of its faces are left.
    Gone,
}

/// The points of a film. Point 0 is the null point that unused lanes refer to; the others lie region by region, with
/// room for duplicates.
///
/// Positions are in units of a power of two near the film's mean edge: products of many lengths then neither overflow
/// nor vanish, and turning them back loses no bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    unit: f32,
    /// PointOffset of each vertex.
    places: Vec<PointOffset>,
    /// Vertex of each point; none for the null point and for room.
    vertices: Vec<u32>,
    /// Room that is left in each region: points from the first to before the second.
    room: Vec<[u32; 2]>,
    now: Vec<Point>,
    /// Where each point was before the last sweep: what its momentum comes from.
    before: Vec<Point>,
    /// Plane at rest: nothing goes below (VC 5).
    planes: Vec<Point>,
    motions: Vec<Motion>,
    /// Region of each vertex.
    region_of: Vec<u16>,
    /// Awake points of each region.
    awake: Vec<Awake>,
    /// Number of vertices that sleep.
    asleep: usize,
}

/// The awake points of a region.
#[derive(Clone, Debug, Default, PartialEq)]
struct Awake {
    /// Padded with the null point to whole groups. In the order of memory, but for those that woke since the last tick.
    places: Vec<PointOffset>,
    count: usize,
    sorted: bool,
}

impl Awake {
    fn push(&mut self, place: PointOffset) {
        self.places.truncate(self.count);
        self.places.push(place);
        self.count += 1;
        self.sorted = false;
        self.pad();
    }

    fn pad(&mut self) {
        self.places.truncate(self.count);
        self.places.resize(self.count.next_multiple_of(GROUP), PointOffset::NULL);
    }
}

impl Points {
    /// The points of vertices at `rest` with their normals, all attached. `mean_edge` is in their unit.
    pub(in crate::deform) fn new(rest: &[Vec3], normals: &[Vec3], mean_edge: f32, layout: &Layout) -> Self {
        // The exponent alone; 1 for films without extent.
        let unit = f32::from_bits(mean_edge.to_bits() & 0x7f80_0000);
        let unit = if unit.is_normal() && (1.0 / unit).is_normal() { unit } else { 1.0 };
        let mut points = Self {
            unit,
            places: vec![PointOffset::NULL; rest.len()],
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
                points.places[i] =
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

    /// PointOffset of vertex `v`; that of the null point for one that does not exist, so that the kernels may trust every place.
    pub(super) fn place(&self, v: u32) -> PointOffset {
        self.places.get(v as usize).copied().unwrap_or(PointOffset::NULL)
    }

    /// The vertex at `place`; none for the null point.
    pub(super) fn vertex(&self, place: PointOffset) -> usize {
        self.vertices[place.index()] as usize
    }

    /// What the vertex at `place` does.
    pub(super) fn motion_at(&self, place: PointOffset) -> Motion {
        self.motions.get(self.vertex(place)).copied().unwrap_or(Motion::Attached)
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.motions.len()
    }

    /// Length, in the film's unit, of the points' unit.
    pub fn unit(&self) -> f32 {
        self.unit
    }

    /// What vertex `v` does.
    #[inline]
    pub fn motion(&self, v: usize) -> Motion {
        self.motions[v]
    }

    /// Position of vertex `v`, in the film's unit.
    #[inline]
    pub fn position(&self, v: usize) -> Vec3 {
        xyz(self.now[self.places[v].index()]) * self.unit
    }

    /// Region of vertex `v`. That of a duplicate is its vertex's.
    #[inline]
    pub fn region_of(&self, v: usize) -> usize {
        self.region_of[v] as usize
    }

    /// Awake vertices.
    pub fn awake(&self) -> impl Iterator<Item = usize> + '_ {
        self.awake.iter().flat_map(|awake| &awake.places[..awake.count]).map(|&place| self.vertex(place))
    }

    /// Number of awake vertices.
    pub fn awake_count(&self) -> usize {
        self.awake.iter().map(|awake| awake.count).sum()
    }

    /// Number of vertices that sleep.
    pub fn asleep_count(&self) -> usize {
        self.asleep
    }

    /// Appends a duplicate of vertex `kept`.
    pub fn duplicate(&mut self, kept: usize) {
        let region = self.region_of(kept);
        self.region_of.push(region as u16);
        let from = self.places[kept].index();
        let (at, before, plane) = (self.now[from], self.before[from], self.planes[from]);
        let v = self.places.len();
        let [next, end] = &mut self.room[region];
        let place = if next < end {
            *next += 1;
            PointOffset::new(*next as usize - 1)
        } else {
            self.push(NO_VERTEX, at, plane)
        };
        let i = place.index();
        (self.now[i], self.before[i], self.planes[i], self.vertices[i]) = (at, before, plane, v as u32);
        self.places.push(place);
        if self.motions[kept] == Motion::Awake {
            self.motions.push(Motion::Attached);
            self.wake(v);
        } else {
            self.motions.push(self.motions[kept]);
            self.asleep += usize::from(self.motions[kept] == Motion::Asleep);
        }
    }

    /// Wakes vertex `v`, unless it is awake; it is at rest where it is, or goes on as it did if it is a duplicate.
    pub fn wake(&mut self, v: usize) {
        if self.motions[v] == Motion::Awake {
            return;
        }
        self.asleep -= usize::from(self.motions[v] == Motion::Asleep);
        self.motions[v] = Motion::Awake;
        let place = self.places[v];
        self.now[place.index()].0[3] = 1.0;
        self.awake[self.region_of[v] as usize].push(place);
    }

    /// Vertex `v` falls asleep; to be followed by [`Self::settle`].
    pub fn rest(&mut self, v: usize) {
        self.asleep += usize::from(self.motions[v] != Motion::Asleep);
        self.motions[v] = Motion::Asleep;
    }

    /// Vertex `v` has no faces left; to be followed by [`Self::settle`].
    pub fn leave(&mut self, v: usize) {
        self.asleep -= usize::from(self.motions[v] == Motion::Asleep);
        self.motions[v] = Motion::Gone;
    }

    /// Brings the lists of awake points into the order of memory. What is done to each is the same in any order.
    pub fn sort(&mut self) {
        for awake in self.awake.iter_mut().filter(|awake| !awake.sorted) {
            awake.places[..awake.count].sort_unstable();
            awake.sorted = true;
        }
    }

    /// Takes the vertices that no longer move off the lists of awake ones.
    pub fn settle(&mut self) {
        let Self { now, before, motions, vertices, awake, .. } = self;
        for awake in awake {
            let mut kept = 0;
            for i in 0..awake.count {
                let place = awake.places[i];
                if motions[vertices[place.index()] as usize] == Motion::Awake {
                    awake.places[kept] = place;
                    kept += 1;
                } else {
                    let point = &mut now[place.index()];
                    point.0[3] = 0.0;
                    before[place.index()] = *point;
                }
            }
            awake.count = kept;
            awake.pad();
        }
    }

    /// Puts vertex `v` to `position` and its last place to `before`, both in the film's unit.
    pub fn put(&mut self, v: usize, position: Vec3, before: Vec3) {
        let scale = 1.0 / self.unit;
        let i = self.places[v].index();
        let mass = self.now[i].0[3];
        self.now[i] = Point((position * scale).extend(mass).to_array());
        self.before[i] = Point((before * scale).extend(mass).to_array());
    }

    /// Where vertex `v` was before the last sweep, in the film's unit.
    pub fn position_before(&self, v: usize) -> Vec3 {
        xyz(self.before[self.places[v].index()]) * self.unit
    }

    /// Writes the positions of awake vertices, in the film's unit.
    pub fn write_awake(&self, positions: &mut [Vec3]) {
        for v in self.awake() {
            positions[v] = self.position(v);
        }
    }

    /// Momentum and half-space of the awake points of a region.
    fn advance(&mut self, kernels: &Kernels, region: usize, keep: f32) {
        let places = &self.awake[region].places;
        // SAFETY: kernels are those of this CPU, and awake points exist.
        unsafe {
            let (now, before) = (self.now.as_mut_ptr(), self.before.as_mut_ptr());
            (kernels.advance)(now, before, self.planes.as_ptr(), places, keep);
        }
    }

    /// Half-space of the awake points of a region.
    fn project(&mut self, kernels: &Kernels, region: usize) {
        // SAFETY: as above.
        unsafe { (kernels.project)(self.now.as_mut_ptr(), self.planes.as_ptr(), &self.awake[region].places) }
    }

    /// The points, for the sweeps.
    pub(super) fn now_mut(&mut self) -> &mut [Point] {
        &mut self.now
    }

    /// One plain or accelerated sweep over `regions` (VC 4.1), one region after the other, as its points are in the cache
    /// then: momentum, bends, lengths, the half-space after each of the first two.
    pub fn sweep(&mut self, regions: &[Region], level: SimdLevel, keep: f32) {
        let kernels = Kernels::of(level);
        for (i, region) in regions.iter().enumerate() {
            self.advance(&kernels, i, keep);
            region.sweep_bends(self, &kernels);
            self.project(&kernels, i);
            region.sweep_lengths(self, &kernels);
        }
    }

    /// Bends alone.
    pub fn sweep_bends(&mut self, regions: &[Region], level: SimdLevel) {
        let kernels = Kernels::of(level);
        regions.iter().for_each(|region| region.sweep_bends(self, &kernels));
    }

    /// Lengths alone.
    pub fn sweep_lengths(&mut self, regions: &[Region], level: SimdLevel) {
        let kernels = Kernels::of(level);
        regions.iter().for_each(|region| region.sweep_lengths(self, &kernels));
    }

    /// The half-space after the last sweep of a step.
    pub fn finish(&mut self, level: SimdLevel) {
        let kernels = Kernels::of(level);
        (0..self.awake.len()).for_each(|region| self.project(&kernels, region));
    }
}

fn xyz(Point([x, y, z, _]): Point) -> Vec3 {
    Vec3::new(x, y, z)
}
