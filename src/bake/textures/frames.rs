//! Computes tangents, and how one set of them lies in another.

use bevy_math::{Mat2, Vec2, Vec3, Vec4};

use crate::appearance::MeshPart;

/// Unit tangents for texture coordinates, as glTF has them: along growing u, with handedness in `w` so that
/// `w normal x tangent` points up in the image. Each is the mean over the vertex's triangles, by their angles there.
pub fn tangents(part: &MeshPart, uvs: &[[f32; 2]], indices: &[u32]) -> Vec<[f32; 4]> {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); part.positions.len()];
    for t in indices.as_chunks::<3>().0 {
        let p = t.map(|v| Vec3::from(part.positions[v as usize]));
        let Some([right, up]) = axes(p, t.map(|v| Vec2::from(uvs[v as usize]))) else { continue };
        for i in 0..3 {
            let (along, back) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            let angle = along.angle_between(back);
            if !angle.is_finite() {
                continue;
            }
            let normal = Vec3::from(part.normals[t[i] as usize]);
            let (sum, hand) = &mut sums[t[i] as usize];
            *sum += (right - normal * right.dot(normal)).normalize_or_zero() * angle;
            *hand += if normal.cross(right).dot(up) < 0.0 { -angle } else { angle };
        }
    }
    let finish = |(i, (sum, hand)): (usize, (Vec3, f32))| {
        let normal = Vec3::from(part.normals[i]);
        let flat = sum - normal * sum.dot(normal);
        let tangent = flat.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        tangent.extend(if hand < 0.0 { -1.0 } else { 1.0 }).to_array()
    };
    sums.into_iter().enumerate().map(finish).collect()
}

/// Unit vectors that are right and up in the image, on a triangle; `None` without area there.
fn axes([a, b, c]: [Vec3; 3], [s, t, u]: [Vec2; 3]) -> Option<[Vec3; 2]> {
    let (e, f, g, h) = (b - a, c - a, t - s, u - s);
    let area = g.perp_dot(h);
    if area == 0.0 {
        return None;
    }
    let sign = area.signum();
    let right = ((e * h.y - f * g.y) * sign).try_normalize()?;
    let down = ((f * g.x - e * h.x) * sign).try_normalize()?;
    Some([right, -down])
}

/// How directions in the frame `from` read in the frame `to`. Both are tangents at one normal.
pub fn turn(normal: Vec3, from: [f32; 4], to: [f32; 4]) -> Mat2 {
    let frame = |t: [f32; 4]| {
        let t = Vec4::from(t);
        (t.truncate(), normal.cross(t.truncate()) * t.w)
    };
    let ((s, t), (u, v)) = (frame(from), frame(to));
    Mat2::from_cols(Vec2::new(s.dot(u), s.dot(v)), Vec2::new(t.dot(u), t.dot(v)))
}

/// From a change of height for a texel to the right and one for a texel down, to slopes along tangent and bitangent.
/// `rest` are a triangle's corners, `texels` the same in the texture.
pub fn slopes([a, b, c]: [Vec3; 3], [s, t, u]: [Vec2; 3]) -> Mat2 {
    let (e, f, g, h) = (b - a, c - a, t - s, u - s);
    let area = g.perp_dot(h);
    if area == 0.0 {
        return Mat2::ZERO;
    }
    // Metres for each texel.
    let (right, down) = ((e * h.y - f * g.y) / area, (f * g.x - e * h.x) / area);
    let Some(tangent) = right.try_normalize() else { return Mat2::ZERO };
    let Some(bitangent) = (-down + tangent * down.dot(tangent)).try_normalize() else { return Mat2::ZERO };
    // The texels' axes in metres along tangent and bitangent: slopes times them are the changes.
    let axes = Mat2::from_cols(
        Vec2::new(right.dot(tangent), right.dot(bitangent)),
        Vec2::new(down.dot(tangent), down.dot(bitangent)),
    );
    let inverse = axes.transpose().inverse();
    if inverse.is_finite() { inverse } else { Mat2::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square in the plane of x and y, seen along -z, and the coordinates of an upright image on it.
    fn square() -> (MeshPart, Vec<[f32; 2]>) {
        let part = MeshPart {
            positions: vec![[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., 0.]],
            normals: vec![[0., 0., 1.]; 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..MeshPart::default()
        };
        (part, vec![[0., 1.], [1., 1.], [1., 0.], [0., 0.]])
    }

    #[test]
    fn an_upright_image_has_a_right_handed_frame() {
        let (part, mut uvs) = square();
        assert_eq!(tangents(&part, &uvs, &part.indices), [[1., 0., 0., 1.]; 4]);
        uvs.iter_mut().for_each(|uv| uv[0] = 1.0 - uv[0]);
        assert_eq!(tangents(&part, &uvs, &part.indices), [[-1., 0., 0., -1.]; 4]);
    }

    #[test]
    fn a_quarter_turn_of_the_image_turns_directions_in_it() {
        let turn = turn(Vec3::Z, [1., 0., 0., 1.], [0., 1., 0., 1.]);
        // What was right, along x, is down for one who calls y right.
        assert!((turn * Vec2::X).abs_diff_eq(Vec2::NEG_Y, 1e-6));
        assert!((turn * Vec2::Y).abs_diff_eq(Vec2::X, 1e-6));
    }

    #[test]
    fn slopes_are_per_metre_whatever_the_texels_are() {
        let p = [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0];
        // 10 texels a metre to the right, 20 downwards, sheared.
        let texel = |p: Vec3| Vec2::new(10.0 * p.x + 3.0 * p.y, -20.0 * p.y);
        let slopes = slopes(p, p.map(texel));
        // Height 0.5 x - 0.25 y. One texel to the right is 0.1 m along x; one down is -0.05 m along y, and as that
        // shears, 0.015 m along x.
        let change = Vec2::new(0.5 * 0.1, 0.5 * 0.015 + 0.25 * 0.05);
        assert!((slopes * change).abs_diff_eq(Vec2::new(0.5, -0.25), 1e-5), "{}", slopes * change);
    }
}
