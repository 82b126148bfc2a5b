//! A point of 16 bytes, so that one load brings all there is of it, and its offset in memory.

/// Position (x, y, z) and inverse mass of a point; or unit normal and distance from the origin of a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(16))]
pub struct Point(pub [f32; 4]);

/// Offset of a point in bytes from the null point, as scaling an index by 16 costs an instruction each time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(transparent)]
pub struct PointOffset(u32);

impl PointOffset {
    /// Offset of the null point.
    pub const NULL: Self = Self(0);

    /// Returns the offset of the point at `index`. Films have far fewer points than the 2^28 that fit.
    pub fn new(index: usize) -> Self {
        Self(index as u32 * 16)
    }

    /// Returns the point at this offset. Wrapping, as the check that others make in debug builds would cost more than
    /// the rest; within the points it is the same.
    #[inline(always)]
    pub fn of(self, points: *const Point) -> *const Point {
        points.wrapping_byte_add(self.0 as usize)
    }

    /// Returns the point at this offset, to be written; see [`of`](Self::of).
    #[inline(always)]
    pub fn of_mut(self, points: *mut Point) -> *mut Point {
        points.wrapping_byte_add(self.0 as usize)
    }

    /// Returns the index of the point.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 / 16) as usize
    }
}
