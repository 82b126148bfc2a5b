//! From masks to a weight at each vertex.

use bevy_math::{Vec3, Vec4};

use super::{
    channel::{Channel, UvSet},
    edges::turns,
    error::MaskError,
    ground::MaskGround,
    mask::{Mask, TextureMask},
    noise::noise_at,
    sites::mean_at_corners,
};
use crate::film::FilmMesh;

impl Mask {
    /// Returns the weight at each vertex of a fresh film, 0 to 1.
    ///
    /// # Errors
    /// [`MaskError::OutOfRange`] and [`MaskError::NoSlope`] as [`validate`](Self::validate) says,
    /// [`MaskError::OtherFilm`] if `mesh` is not of the built film, [`MaskError::NoImage`],
    /// [`MaskError::NoCoordinates`] and [`MaskError::NoColors`] if something that the mask looks at is not there.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, masks::{Mask, MaskGround, MaskImages}, remesh::sample};
    /// use bevy_math::Vec3;
    ///
    /// let piece = sample::plate(200, 7)?;
    /// let mesh = FilmMesh::new(piece.film.positions.clone(), &piece.film.triangles)?;
    /// let images = MaskImages::new();
    /// let ground =
    ///     MaskGround { surface: &piece.surface, built: &piece.film, gravity: Vec3::NEG_Y, images: &images };
    /// let weights = Mask::lower(0.5).weights(&mesh, &ground)?;
    /// for (weight, place) in weights.iter().zip(&piece.film.positions) {
    ///     assert_eq!(*weight == 0.0, place.y >= 0.0, "the upper half has none");
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn weights(&self, mesh: &FilmMesh, ground: &MaskGround) -> Result<Vec<f32>, MaskError> {
        self.validate()?;
        let (found, expected) = (mesh.topology.vertex_count(), ground.built.positions.len());
        if found != expected {
            return Err(MaskError::OtherFilm { found, expected });
        }
        self.weigh(mesh, ground)
    }

    fn weigh(&self, mesh: &FilmMesh, ground: &MaskGround) -> Result<Vec<f32>, MaskError> {
        let geometry = &mesh.geometry;
        let places = &geometry.rest_positions;
        let vertices = places.len();
        let gravity = ground.gravity.try_normalize();
        Ok(match *self {
            Self::Even(weight) => vec![weight; vertices],
            Self::Texture(ref texture) => texture_weights(texture, vertices, ground)?,
            Self::Color(channel) => {
                let colors = &ground.surface.colors;
                if colors.is_empty() {
                    return Err(MaskError::NoColors);
                }
                let channel = |color: Vec4| match channel {
                    Channel::Red => color.x,
                    Channel::Green => color.y,
                    Channel::Blue => color.z,
                    Channel::Alpha => color.w,
                };
                mean_at_corners(ground, vertices, |i| colors.get(i).copied(), |color| unit(channel(color)))
            }
            Self::Edges { reach, soft, sharp } => {
                turns(mesh, ground, reach).into_iter().map(|turn| slope(turn, soft, sharp)).collect()
            }
            Self::Lower { full, none } => heights(places, gravity)
                .map(|heights| heights.into_iter().map(|height| slope(height, none, full)).collect())
                .unwrap_or_else(|| vec![0.0; vertices]),
            Self::Under { full, none } => {
                let down = |normal: &Vec3| gravity.map_or(0.0, |gravity| slope(normal.dot(gravity), none, full));
                geometry.rest_normals.iter().map(down).collect()
            }
            Self::Noise { seed, wavelength } => noise_at(places, seed, wavelength),
            Self::Multiply(ref masks) => combine(masks, mesh, ground, 1.0, |a, b| a * b)?,
            Self::Max(ref masks) => combine(masks, mesh, ground, 0.0, f32::max)?,
            Self::Invert(ref mask) => mask.weigh(mesh, ground)?.into_iter().map(|weight| 1.0 - weight).collect(),
            Self::Levels { ref mask, black, white } => {
                mask.weigh(mesh, ground)?.into_iter().map(|weight| slope(weight, black, white)).collect()
            }
            Self::Custom(ref custom) => {
                places.iter().zip(&geometry.rest_normals).map(|(&p, &n)| unit(custom.weigh(p, n))).collect()
            }
        })
    }
}

fn texture_weights(texture: &TextureMask, vertices: usize, ground: &MaskGround) -> Result<Vec<f32>, MaskError> {
    let name = || texture.image.clone();
    let Some(image) = ground.images.get(&texture.image) else {
        return Err(MaskError::NoImage { name: name(), known: ground.images.keys().cloned().collect() });
    };
    let uvs = match texture.uv {
        UvSet::First => &ground.surface.uvs,
        UvSet::Second => &ground.surface.uvs_1,
    };
    if uvs.is_empty() {
        return Err(MaskError::NoCoordinates { image: name(), uv: texture.uv });
    }
    let at = |i: usize| uvs.get(i).map(|uv| uv.extend(0.0).extend(0.0));
    let sample = |uv: Vec4| image.sample(uv.truncate().truncate(), texture.channel, texture.wrap);
    Ok(mean_at_corners(ground, vertices, at, sample))
}

/// Returns the weights of `masks` folded into one by `fold`, from `start` on.
fn combine(
    masks: &[Mask],
    mesh: &FilmMesh,
    ground: &MaskGround,
    start: f32,
    fold: fn(f32, f32) -> f32,
) -> Result<Vec<f32>, MaskError> {
    let mut all = vec![start; mesh.topology.vertex_count()];
    for mask in masks {
        for (weight, other) in all.iter_mut().zip(mask.weigh(mesh, ground)?) {
            *weight = fold(*weight, other);
        }
    }
    Ok(all)
}

/// Returns the height of each place over the lowest, as a share of that of the highest; `None` if there is no gravity
/// or all are as high.
fn heights(places: &[Vec3], gravity: Option<Vec3>) -> Option<Vec<f32>> {
    let gravity = gravity?;
    let heights: Vec<f32> = places.iter().map(|place| -place.dot(gravity)).collect();
    let low = heights.iter().copied().fold(f32::INFINITY, f32::min);
    let high = heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    (high > low).then(|| heights.into_iter().map(|height| (height - low) / (high - low)).collect())
}

/// Returns 0 at `zero`, 1 at `one`, and what lies on the straight line between them.
fn slope(value: f32, zero: f32, one: f32) -> f32 {
    unit((value - zero) / (one - zero))
}

/// Brings a weight into 0 to 1; NaN counts as 0.
fn unit(weight: f32) -> f32 {
    if weight > 0.0 { weight.min(1.0) } else { 0.0 }
}
