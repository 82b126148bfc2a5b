//! Points of the packed solver: 16 bytes each, so that one load brings all there is.

use bevy_math::Vec3;

use super::level::{Kernels, SimdLevel};

/// Position (x, y, z) and inverse mass of a point; or unit normal and distance from the origin of a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(16))]
pub struct Point(pub(super) [f32; 4]);

/// Where a point lies: its offset in bytes, as scaling an index by 16 costs an instruction each time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub(super) struct Place(u32);

impl Place {
    /// Of the null point.
    pub const NULL: Self = Self(0);

    /// Of vertex `v`. Films have far fewer vertices than the 2^28 that fit.
    pub fn of(v: usize) -> Self {
        Self((v as u32 + 1) * 16)
    }

    /// Offset from the first point, in bytes.
    #[inline(always)]
    pub fn bytes(self) -> usize {
        self.0 as usize
    }

    /// The vertex; meaningless for the null point.
    pub fn vertex(self) -> usize {
        (self.0 / 16) as usize - 1
    }
}

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

/// The points of a film: point `v + 1` is vertex `v`, point 0 is the null point that unused lanes refer to.
///
/// Positions are in units of a power of two near the film's mean edge: products of many lengths then neither overflow
/// nor vanish, and turning them back loses no bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    unit: f32,
    now: Vec<Point>,
    /// Where each point was before the last sweep: what its momentum comes from.
    before: Vec<Point>,
    /// Plane at rest: nothing goes below (VC 5).
    planes: Vec<Point>,
    motions: Vec<Motion>,
    /// Awake points in the order in which they woke, padded with the null point to whole groups.
    awake: Vec<Place>,
    awake_count: usize,
}

impl Points {
    /// The points of vertices at `rest` with their normals, all attached. `mean_edge` is in their unit.
    pub fn new(rest: &[Vec3], normals: &[Vec3], mean_edge: f32) -> Self {
        // The exponent alone; 1 for films without extent.
        let unit = f32::from_bits(mean_edge.to_bits() & 0x7f80_0000);
        let unit = if unit.is_normal() && (1.0 / unit).is_normal() { unit } else { 1.0 };
        let scaled = rest.iter().map(|&p| (p / unit).extend(0.0));
        let now: Vec<Point> = std::iter::once(Point::default()).chain(scaled.map(|p| Point(p.to_array()))).collect();
        let planes = rest.iter().zip(normals).map(|(&p, &n)| Point(n.extend(n.dot(p / unit)).to_array()));
        Self {
            unit,
            before: now.clone(),
            planes: std::iter::once(Point::default()).chain(planes).collect(),
            motions: vec![Motion::Attached; rest.len()],
            now,
            awake: Vec::new(),
            awake_count: 0,
        }
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
        xyz(self.now[v + 1]) * self.unit
    }

    /// Awake vertices, in the order in which they woke.
    pub fn awake(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.awake[..self.awake_count].iter().map(|place| place.vertex())
    }

    /// Number of awake vertices.
    pub fn awake_count(&self) -> usize {
        self.awake_count
    }

    /// Appends a duplicate of vertex `kept`.
    pub fn duplicate(&mut self, kept: usize) {
        self.now.push(self.now[kept + 1]);
        self.before.push(self.before[kept + 1]);
        self.planes.push(self.planes[kept + 1]);
        self.motions.push(Motion::Attached);
        match self.motions[kept] {
            Motion::Awake => self.wake(self.motions.len() - 1),
            other => {
                let last = self.motions.len() - 1;
                self.motions[last] = other;
            }
        }
    }

    /// Wakes vertex `v`, unless it is awake; it is at rest where it is, or goes on as it did if it is a duplicate.
    pub fn wake(&mut self, v: usize) {
        if self.motions[v] == Motion::Awake {
            return;
        }
        self.motions[v] = Motion::Awake;
        self.now[v + 1].0[3] = 1.0;
        self.awake.truncate(self.awake_count);
        self.awake.push(Place::of(v));
        self.awake_count += 1;
        self.awake.resize(self.awake_count.next_multiple_of(GROUP), Place::NULL);
    }

    /// Takes vertices off the list of awake ones: `judge` gives what becomes of each.
    pub fn settle(&mut self, mut judge: impl FnMut(&Self, usize) -> Motion) {
        let mut kept = 0;
        for place in 0..self.awake_count {
            let point = self.awake[place];
            let v = point.vertex();
            let motion = judge(self, v);
            if motion == Motion::Awake {
                self.awake[kept] = point;
                kept += 1;
            } else {
                self.motions[v] = motion;
                self.now[v + 1].0[3] = 0.0;
                self.before[v + 1] = self.now[v + 1];
            }
        }
        self.awake_count = kept;
        self.awake.truncate(kept);
        self.awake.resize(kept.next_multiple_of(GROUP), Place::NULL);
    }

    /// Puts vertex `v` to `position` and its last place to `before`, both in the film's unit.
    pub fn put(&mut self, v: usize, position: Vec3, before: Vec3) {
        let scale = 1.0 / self.unit;
        let mass = self.now[v + 1].0[3];
        self.now[v + 1] = Point((position * scale).extend(mass).to_array());
        self.before[v + 1] = Point((before * scale).extend(mass).to_array());
    }

    /// Where vertex `v` was before the last sweep, in the film's unit.
    pub fn position_before(&self, v: usize) -> Vec3 {
        xyz(self.before[v + 1]) * self.unit
    }

    /// Writes the positions of awake vertices, in the film's unit.
    pub fn write_awake(&self, positions: &mut [Vec3]) {
        for v in self.awake() {
            positions[v] = self.position(v);
        }
    }

    /// Momentum and half-space of the awake points.
    pub(super) fn advance(&mut self, kernels: &Kernels, keep: f32) {
        // SAFETY: kernels are those of this CPU, and awake points exist.
        unsafe {
            let (now, before) = (self.now.as_mut_ptr(), self.before.as_mut_ptr());
            (kernels.advance)(now, before, self.planes.as_ptr(), &self.awake, keep);
        }
    }

    /// Half-space of the awake points.
    pub(super) fn project(&mut self, kernels: &Kernels) {
        // SAFETY: as above.
        unsafe { (kernels.project)(self.now.as_mut_ptr(), self.planes.as_ptr(), &self.awake) }
    }

    /// The points, for the sweeps.
    pub(super) fn now_mut(&mut self) -> &mut [Point] {
        &mut self.now
    }

    /// One plain or accelerated sweep over `regions` (VC 4.1): momentum, bends, lengths, each followed by the half-space.
    pub fn sweep(&mut self, regions: &[super::Region], level: SimdLevel, keep: f32) {
        let kernels = Kernels::of(level);
        self.advance(&kernels, keep);
        for region in regions {
            region.sweep_bends(self, &kernels);
        }
        self.project(&kernels);
        for region in regions {
            region.sweep_lengths(self, &kernels);
        }
    }

    /// Bends alone.
    pub fn sweep_bends(&mut self, regions: &[super::Region], level: SimdLevel) {
        let kernels = Kernels::of(level);
        regions.iter().for_each(|region| region.sweep_bends(self, &kernels));
    }

    /// Lengths alone.
    pub fn sweep_lengths(&mut self, regions: &[super::Region], level: SimdLevel) {
        let kernels = Kernels::of(level);
        regions.iter().for_each(|region| region.sweep_lengths(self, &kernels));
    }

    /// The half-space after the last sweep of a step.
    pub fn finish(&mut self, level: SimdLevel) {
        self.project(&Kernels::of(level));
    }
}

fn xyz(Point([x, y, z, _]): Point) -> Vec3 {
    Vec3::new(x, y, z)
}
