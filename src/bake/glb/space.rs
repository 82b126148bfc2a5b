//! Moves parts of the scene into the space of a node, and chooses the node.

use std::borrow::Cow;

use bevy_math::{DMat3, DMat4, DVec3, Vec3};

use crate::{
    appearance::{METAL_DEPTH, MeshPart},
    bake::{coat::Prop, model::Place},
    sim::FilmState,
};

/// How much coarser than the depth of the metal single precision may be, so that what lies close does not flicker.
const COARSENESS: f64 = 0.1;
/// Half of the last place of a number of single precision, for each unit of it.
const PRECISION: f64 = 6e-8;

/// Where an aged mesh is put.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Home {
    /// On the prop's own node, in the node's space.
    Node,
    /// On a child of the node, moved so far: the node's own zero is too far away for single precision.
    Child(Vec3),
    /// On a node of the scene's own, moved so far: the prop's node is flat, or there is none.
    Scene(Vec3),
}

/// From around a prop's origin in the scene into the space of a node.
#[derive(Clone, Copy, Debug)]
pub struct NodeSpace {
    origin: DVec3,
    inverse: DMat4,
    shift: DVec3,
    /// For normals: the transpose of the node's own transform.
    normals: DMat3,
    mirrored: bool,
}

impl Home {
    /// Chooses where the aged mesh of a prop is put, and the space it has there; `None`: the scene's, around the prop's
    /// origin.
    pub fn of(prop: &Prop, film: &FilmState) -> (Self, Option<NodeSpace>) {
        let scene = Self::in_scene(prop);
        let Some(Place { transform, .. }) = &prop.place else { return scene };
        let inverse = transform.inverse();
        let identity = inverse * *transform;
        if !inverse.is_finite() || !identity.abs_diff_eq(DMat4::IDENTITY, 1e-6) {
            return scene;
        }
        let linear = DMat3::from_mat4(*transform);
        let origin = prop.origin.as_dvec3();
        let middle = inverse.transform_point3(origin);
        // Metres in the scene that the last place of a coordinate is worth.
        let longest = [linear.x_axis, linear.y_axis, linear.z_axis].map(DVec3::length).into_iter().fold(0.0, f64::max);
        let coarseness = middle.abs().max_element() * PRECISION * longest;
        let far = coarseness > COARSENESS * f64::from(METAL_DEPTH * film.mesh.geometry.mean_edge);
        let shift = if far { middle.as_vec3() } else { Vec3::ZERO };
        let space = NodeSpace {
            origin,
            inverse,
            shift: shift.as_dvec3(),
            normals: linear.transpose(),
            mirrored: linear.determinant() < 0.0,
        };
        (if far { Self::Child(shift) } else { Self::Node }, Some(space))
    }
}

impl Home {
    /// Puts the aged mesh of a prop on a node of the scene's own, around the prop's origin.
    fn in_scene(prop: &Prop) -> (Self, Option<NodeSpace>) {
        if prop.metres_per_unit == 1.0 {
            return (Self::Scene(prop.origin), None);
        }
        let scale = 1.0 / f64::from(prop.metres_per_unit);
        let at = (prop.origin.as_dvec3() * scale).as_vec3();
        let inverse = DMat4::from_scale(DVec3::splat(scale));
        let normals = DMat3::IDENTITY;
        let space = NodeSpace { origin: DVec3::ZERO, inverse, shift: DVec3::ZERO, normals, mirrored: false };
        (Self::Scene(at), Some(space))
    }
}

impl NodeSpace {
    /// Moves a part.
    pub fn part<'a>(&self, part: &'a MeshPart) -> Cow<'a, MeshPart> {
        let mut moved = part.clone();
        for position in &mut moved.positions {
            let p = Vec3::from(*position).as_dvec3() + self.origin;
            *position = (self.inverse.transform_point3(p) - self.shift).as_vec3().to_array();
        }
        for normal in &mut moved.normals {
            let n = self.normals * Vec3::from(*normal).as_dvec3();
            *normal = n.try_normalize().map_or(*normal, |n| n.as_vec3().to_array());
        }
        for (i, tangent) in moved.tangents.iter_mut().enumerate() {
            let [x, y, z, hand] = *tangent;
            let normal = moved.normals.get(i).map_or(Vec3::Y, |&n| n.into());
            let along = self.inverse.transform_vector3(DVec3::new(x.into(), y.into(), z.into())).as_vec3();
            // Scales that differ do not keep the right angle.
            let along = along - normal * along.dot(normal);
            let along = along.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
            *tangent = along.extend(if self.mirrored { -hand } else { hand }).to_array();
        }
        if self.mirrored {
            for triangle in moved.indices.as_chunks_mut::<3>().0 {
                triangle.swap(1, 2);
            }
        }
        Cow::Owned(moved)
    }
}
