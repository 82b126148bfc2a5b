//! Instruction sets, chosen while the program runs.

use super::{
    kernels,
    lanes::{self, vector::Lanes},
    pack::{BendPack, BendTargets, LengthPack},
    point::{Point, PointOffset},
};

/// Instruction set that the packed solver has kernels for. All give the same bits.
///
/// ```
/// use bevy_coating::deform::SimdLevel;
///
/// assert!(SimdLevel::best().is_available() && SimdLevel::Scalar.is_available());
/// assert_eq!(SimdLevel::default(), SimdLevel::best());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SimdLevel {
    /// One float at a time, on any CPU.
    Scalar,
    /// NEON: 64-bit ARM.
    Neon,
    /// SSE2: any x86-64.
    Sse2,
    /// AVX2.
    Avx2,
    /// AVX-512 F and VL.
    Avx512,
}

impl SimdLevel {
    /// All levels, the slowest first.
    pub const ALL: [Self; 5] = [Self::Scalar, Self::Neon, Self::Sse2, Self::Avx2, Self::Avx512];

    /// Returns whether this CPU has the instruction set.
    pub fn is_available(self) -> bool {
        match self {
            Self::Scalar => true,
            Self::Neon => cfg!(target_arch = "aarch64"),
            Self::Sse2 => cfg!(target_arch = "x86_64"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::arch::is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// Returns the best level that this CPU has.
    pub fn best() -> Self {
        Self::ALL.into_iter().rev().find(|level| level.is_available()).unwrap_or(Self::Scalar)
    }

    /// Returns the lower-case name, as in benchmarks.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Neon => "neon",
            Self::Sse2 => "sse2",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

impl Default for SimdLevel {
    fn default() -> Self {
        Self::best()
    }
}

/// Kernels of one level.
///
/// # Safety
/// To be called only where the level is available, with indices within the points.
#[derive(Clone, Copy)]
pub struct Kernels {
    pub sweep_bends: unsafe fn(*mut Point, &[BendPack]),
    pub sweep_lengths: unsafe fn(*mut Point, &[LengthPack]),
    pub project: unsafe fn(*mut Point, *const Point, &[PointOffset]),
    pub advance: unsafe fn(*mut Point, *mut Point, *const Point, &[PointOffset], f32),
    pub narrow: unsafe fn(&mut BendPack, &mut BendTargets, f32, f32) -> bool,
}

/// Compiles the kernels with an instruction set.
macro_rules! kernels_with {
    ($Lanes:ty $(, $feature:literal)?) => {{
        $(#[target_feature(enable = $feature)])?
        unsafe fn sweep_bends(points: *mut Point, packs: &[BendPack]) {
            // SAFETY: the caller's, as in the functions below.
            unsafe { kernels::sweep_bends::<$Lanes>(points, packs) }
        }
        $(#[target_feature(enable = $feature)])?
        unsafe fn sweep_lengths(points: *mut Point, packs: &[LengthPack]) {
            unsafe { kernels::sweep_lengths::<$Lanes>(points, packs) }
        }
        $(#[target_feature(enable = $feature)])?
        unsafe fn project(points: *mut Point, planes: *const Point, offsets: &[PointOffset]) {
            unsafe { kernels::project::<$Lanes>(points, planes, offsets) }
        }
        $(#[target_feature(enable = $feature)])?
        unsafe fn advance(
            points: *mut Point,
            before: *mut Point,
            planes: *const Point,
            offsets: &[PointOffset],
            keep: f32,
        ) {
            unsafe { kernels::advance::<$Lanes>(points, before, planes, offsets, keep) }
        }
        $(#[target_feature(enable = $feature)])?
        unsafe fn narrow(pack: &mut BendPack, angles: &mut BendTargets, step: f32, limit: f32) -> bool {
            unsafe { kernels::narrow::<$Lanes>(pack, angles, step, limit) }
        }
        const { assert!(super::pack::LANES.is_multiple_of(<$Lanes as Lanes>::WIDTH)) };
        Kernels { sweep_bends, sweep_lengths, project, advance, narrow }
    }};
}

impl Kernels {
    /// Returns the kernels of `level`, or of the scalar twin if this CPU does not have it.
    pub fn of(level: SimdLevel) -> Self {
        if !level.is_available() {
            return kernels_with!(lanes::scalar::Scalar);
        }
        match level {
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Sse2 => kernels_with!(lanes::sse2::Sse2),
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => kernels_with!(lanes::pair::Pair<lanes::avx2::Avx2>, "avx2"),
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => kernels_with!(lanes::pair::Pair<lanes::avx512::Avx512>, "avx512f,avx512vl"),
            #[cfg(target_arch = "aarch64")]
            SimdLevel::Neon => kernels_with!(lanes::neon::Neon),
            _ => kernels_with!(lanes::scalar::Scalar),
        }
    }
}
