//! Derives the seed of a film from the place of its prop and from the path to its mesh.

use bevy_math::{DVec3, Vec3};

/// Size of the cells in which places have different seeds, in metres. Smaller differences come from rounding.
const CELL: f64 = 0.01;

/// Step on the way from a prop down to one of its meshes: the name of a node and its number among the siblings with the
/// same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathStep<'a> {
    /// Name of the node; empty if it has none.
    pub name: &'a str,
    /// Number of siblings of the same name before it.
    pub number: u32,
}

/// Returns the seed of a prop at `place`, in metres: another one for every centimetre.
///
/// ```
/// use bevy_coating::sim::place_seed;
/// use bevy_math::Vec3;
///
/// assert_eq!(place_seed(Vec3::new(2.0, 0.0, 1.0)), place_seed(Vec3::new(2.000_001, 0.0, 1.0)));
/// assert_ne!(place_seed(Vec3::ZERO), place_seed(Vec3::X));
/// ```
pub fn place_seed(place: Vec3) -> u64 {
    // The conversion saturates, and NaN becomes 0.
    let cell = |x: f64| (x / CELL).round() as i64;
    let place: DVec3 = place.as_dvec3();
    let mut hash = Hash::new();
    place.to_array().iter().for_each(|&x| hash.add(&cell(x).to_le_bytes()));
    hash.end()
}

/// Returns the seed of the film of a mesh: the prop's seed `base`, varied by the `path` from the prop's root to the
/// mesh. So the four wheels of a car do not crack alike, and two cars with the same seed do. An empty path, of a mesh
/// that is the prop itself, leaves `base` as it is.
///
/// ```
/// use bevy_coating::sim::{PathStep, film_seed};
///
/// let wheel = |number| film_seed(7, &[PathStep { name: "wheel", number }]);
/// assert_ne!(wheel(0), wheel(1));
/// assert_eq!(film_seed(7, &[]), 7);
/// ```
pub fn film_seed(base: u64, path: &[PathStep<'_>]) -> u64 {
    if path.is_empty() {
        return base;
    }
    let mut hash = Hash::new();
    hash.add(&base.to_le_bytes());
    for step in path {
        hash.add(&(step.name.len() as u64).to_le_bytes());
        hash.add(step.name.as_bytes());
        hash.add(&step.number.to_le_bytes());
    }
    hash.end()
}

/// Hash FNV-1a of 64 bits, the same on every machine and in every release, with the finalizer of MurmurHash3.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn end(self) -> u64 {
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        let mixed = (mixed ^ (mixed >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        mixed ^ (mixed >> 33)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(name: &str, number: u32) -> PathStep<'_> {
        PathStep { name, number }
    }

    #[test]
    fn every_place_and_every_path_has_its_own_seed() {
        let mut seeds: Vec<u64> = Vec::new();
        for x in 0..20 {
            for z in 0..20 {
                seeds.push(place_seed(Vec3::new(x as f32 * 0.5, 0.0, z as f32 * 0.5)));
            }
        }
        for number in 0..100 {
            seeds.push(film_seed(1, &[step("wheel", number)]));
            seeds.push(film_seed(1, &[step("", 0), step("wheel", number)]));
            seeds.push(film_seed(2, &[step("wheel", number)]));
        }
        // The end of one name and the beginning of the next must not run into each other.
        seeds.extend([film_seed(1, &[step("ab", 0), step("c", 0)]), film_seed(1, &[step("a", 0), step("bc", 0)])]);
        let count = seeds.len();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), count);
    }

    #[test]
    fn seeds_are_the_same_on_every_machine() {
        assert_eq!(place_seed(Vec3::ZERO), place_seed(Vec3::new(-0.0, 0.004, -0.004)));
        assert_eq!(place_seed(Vec3::NAN), place_seed(Vec3::ZERO), "a place that is nowhere is no error");
        // Computed by another program.
        assert_eq!(film_seed(7, &[step("wheel", 2)]), 0xfc33_c9d6_df6d_246c);
        assert_eq!(place_seed(Vec3::new(1.0, 2.0, 3.0)), 0x94bd_fd62_00d0_9468);
    }
}
