//! Packs rectangles into a square.

use bevy_math::{UVec2, Vec2};
use guillotiere::{SimpleAtlasAllocator, size2};

/// Trials to find the largest scale that fits.
const TRIALS: u32 = 14;

/// Packs rectangles of `sizes` into a square of `side` texels, as large as they can be, with `padding` texels around
/// each. Returns the scale, in texels a unit, and the corners inside the padding; `None` if they do not fit
/// even as single texels.
pub fn pack(sizes: &[Vec2], side: u32, padding: u32) -> Option<(f32, Vec<UVec2>)> {
    let area: f32 = sizes.iter().map(|size| size.x * size.y).sum();
    let longest = sizes.iter().map(|size| size.max_element()).fold(0.0, f32::max);
    let bound = (side as f32 / area.sqrt()).min(side as f32 / longest);
    let (mut fits, mut best) = (0.0, try_pack(sizes, 0.0, side, padding)?);
    if !bound.is_finite() {
        return Some((fits, best));
    }
    let mut too_large = bound;
    for _ in 0..TRIALS {
        let scale = (fits + too_large) * 0.5;
        match try_pack(sizes, scale, side, padding) {
            Some(corners) => (fits, best) = (scale, corners),
            None => too_large = scale,
        }
    }
    Some((fits, best))
}

fn try_pack(sizes: &[Vec2], scale: f32, side: u32, padding: u32) -> Option<Vec<UVec2>> {
    // A texel more than its size, as a corner may lie anywhere in a texel.
    let texels = |i: usize| (sizes[i] * scale).ceil().as_uvec2() + 1 + 2 * padding;
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse((texels(i).max_element(), texels(i).min_element())));
    let mut free = SimpleAtlasAllocator::new(size2(side as i32, side as i32));
    let mut corners = vec![UVec2::ZERO; sizes.len()];
    for i in order {
        let wanted = texels(i);
        if wanted.max_element() > side {
            return None;
        }
        let place = free.allocate(size2(wanted.x as i32, wanted.y as i32))?;
        corners[i] = UVec2::new(place.min.x as u32, place.min.y as u32) + padding;
    }
    Some(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_fill_the_square_and_do_not_meet() {
        let sizes: Vec<Vec2> = (1..60u32).map(|i| Vec2::new((i % 7 + 1) as f32, (i % 5 + 1) as f32)).collect();
        let (scale, corners) = pack(&sizes, 512, 2).expect("room");
        let area: f32 = sizes.iter().map(|size| size.x * size.y).sum();
        assert!(area * scale * scale > 0.65 * 512.0 * 512.0, "{}", area * scale * scale / 512.0 / 512.0);
        let ends: Vec<UVec2> =
            corners.iter().zip(&sizes).map(|(c, &size)| c + (size * scale).ceil().as_uvec2() + 1).collect();
        for i in 0..sizes.len() {
            assert!(corners[i].min_element() >= 2 && ends[i].max_element() <= 510);
            for j in 0..i {
                let apart = |k: usize| corners[i][k] >= ends[j][k] + 4 || corners[j][k] >= ends[i][k] + 4;
                assert!(apart(0) || apart(1), "{i} and {j}");
            }
        }
    }

    #[test]
    fn too_many_do_not_fit() {
        assert!(pack(&[Vec2::ONE; 1000], 64, 2).is_none());
        assert_eq!(pack(&[], 64, 2).map(|(_, corners)| corners.len()), Some(0));
    }
}
