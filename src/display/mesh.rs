//! Writes the arrays of a part to a Bevy mesh.

use bevy::{
    asset::RenderAssetUsages,
    math::Vec3,
    mesh::{Indices, Mesh, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues, VertexFormat},
};

use super::canvas::{StainCanvas, StainCarrier};
use crate::{
    appearance::{IndexRanges, MeshPart, PartChanges},
    mesh_reader::SlotAttributes,
};

/// Vertex attribute with the stains of a film's meshes: layers of rust (0 to 1), dust, moisture and corrosion of the
/// metal, as [`MeshPart::stains`] has them. It is present while stains are drawn by a material
/// ([`StainDisplay::Material`](crate::api::stain_display::StainDisplay::Material)).
///
/// ```
/// use bevy::{mesh::VertexAttributeValues, prelude::*};
/// use bevy_coating::ATTRIBUTE_STAINS;
///
/// /// Returns the rust on each vertex of a film's mesh.
/// fn rust(mesh: &Mesh) -> Vec<f32> {
///     match mesh.attribute(ATTRIBUTE_STAINS) {
///         Some(VertexAttributeValues::Float32x4(stains)) => stains.iter().map(|stains| stains[0]).collect(),
///         _ => Vec::new(),
///     }
/// }
///
/// assert!(rust(&Cuboid::default().into()).is_empty(), "a mesh that no film was built of");
/// ```
pub const ATTRIBUTE_STAINS: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_Stains", 0x636f_6174_7374_6169, VertexFormat::Float32x4);

/// Vertex attribute with the position at rest of a film's meshes, in metres in the film's space ([`MeshPart::rest`]).
/// It is present while stains are drawn by a material.
pub const ATTRIBUTE_REST: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_Rest", 0x636f_6174_7265_7374, VertexFormat::Float32x3);

/// Vertex attribute with the unit normal at rest of a film's meshes ([`MeshPart::rest_normals`]). It is present while
/// stains are drawn by a material.
pub const ATTRIBUTE_REST_NORMAL: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_RestNormal", 0x636f_6174_6e6f_726d, VertexFormat::Float32x3);

/// Transform from the film's space, which has the prop's world scale applied and is in metres, to the space of the
/// prop's mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartSpace {
    scale: Vec3,
    /// Point of the scaled mesh that is zero in the film's space.
    origin: Vec3,
    /// Whether directions change, too.
    skewed: bool,
    /// Whether the film is a mirror image of the prop's mesh.
    mirrored: bool,
}

impl PartSpace {
    /// Returns the transform for a prop that was scaled by `scale`, whose film has its zero at `origin` of the scaled
    /// mesh.
    pub fn new(scale: Vec3, origin: Vec3) -> Self {
        Self {
            scale,
            origin,
            skewed: scale.x != scale.y || scale.y != scale.z || scale.x < 0.0,
            mirrored: scale.x * scale.y * scale.z < 0.0,
        }
    }

    /// Returns whether the film is a mirror image of the prop's mesh.
    #[cfg(feature = "render")]
    pub fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    pub(super) fn position(&self, p: [f32; 3]) -> [f32; 3] {
        ((Vec3::from_array(p) + self.origin) / self.scale).to_array()
    }

    /// Transforms a normal by the inverse transpose, which undoes the transform that it was read with.
    pub(super) fn normal(&self, n: [f32; 3]) -> [f32; 3] {
        if self.skewed { (Vec3::from_array(n) * self.scale).normalize_or_zero().to_array() } else { n }
    }

    fn tangent(&self, [x, y, z, w]: [f32; 4]) -> [f32; 4] {
        if self.skewed {
            (Vec3::new(x, y, z) / self.scale).normalize_or_zero().extend(w).to_array()
        } else {
            [x, y, z, w]
        }
    }

    pub(super) fn index_order(&self) -> [usize; 3] {
        if self.mirrored { [0, 2, 1] } else { [0, 1, 2] }
    }
}

/// Returns an empty mesh that stays in the main world, so that it can be rewritten.
pub(super) fn new_mesh() -> Mesh {
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::MAIN_WORLD | RenderAssetUsages::RENDER_WORLD)
}

/// Writes a whole part: positions, normals, the further attributes that the prop's own mesh has, and the attributes
/// that carry the stains. For an empty part it writes one triangle without area, as a mesh must not be empty, and
/// returns false.
pub(super) fn write_part(
    mesh: &mut Mesh,
    part: &MeshPart,
    attributes: SlotAttributes,
    space: PartSpace,
    canvas: &StainCanvas,
) -> bool {
    let count = part.positions.len();
    let nothing = part.is_empty();
    let positions: Vec<_> = part.positions.iter().map(|&p| space.position(p)).collect();
    insert(mesh, Mesh::ATTRIBUTE_POSITION, whole(&positions, nothing, [0.0; 3]));
    let normals: Vec<_> = part.normals.iter().map(|&n| space.normal(n)).collect();
    insert(mesh, Mesh::ATTRIBUTE_NORMAL, whole(&normals, nothing, [0.0, 0.0, 1.0]));
    if attributes.uvs && (nothing || part.uvs.len() == count) {
        insert(mesh, Mesh::ATTRIBUTE_UV_0, whole(&part.uvs, nothing, [0.0; 2]));
    }
    if attributes.uvs_1 && (nothing || part.uvs_1.len() == count) {
        insert(mesh, Mesh::ATTRIBUTE_UV_1, whole(&part.uvs_1, nothing, [0.0; 2]));
    }
    if attributes.tangents && (nothing || part.tangents.len() == count) {
        let tangents: Vec<_> = part.tangents.iter().map(|&t| space.tangent(t)).collect();
        insert(mesh, Mesh::ATTRIBUTE_TANGENT, whole(&tangents, nothing, [1.0, 0.0, 0.0, 1.0]));
    }
    if attributes.colors && (nothing || part.colors.len() == count) {
        insert(mesh, Mesh::ATTRIBUTE_COLOR, whole(&part.colors, nothing, [1.0; 4]));
    } else {
        remove(mesh, Mesh::ATTRIBUTE_COLOR);
    }
    if canvas.carrier() == StainCarrier::Attributes {
        insert(mesh, ATTRIBUTE_REST, whole(&part.rest, nothing, [0.0; 3]));
        insert(mesh, ATTRIBUTE_REST_NORMAL, whole(&part.rest_normals, nothing, [0.0, 0.0, 1.0]));
    } else {
        remove(mesh, ATTRIBUTE_REST);
        remove(mesh, ATTRIBUTE_REST_NORMAL);
        remove(mesh, ATTRIBUTE_STAINS);
    }
    match canvas.carrier() {
        StainCarrier::Attributes => insert(mesh, ATTRIBUTE_STAINS, whole(canvas.stains(), nothing, [0.0; 4])),
        StainCarrier::Colors => insert(mesh, Mesh::ATTRIBUTE_COLOR, whole(canvas.colors(), nothing, [1.0; 4])),
        StainCarrier::Nothing => {}
    }
    let [a, b, c] = space.index_order();
    let indices =
        if nothing { vec![0, 1, 2] } else { part.indices.chunks_exact(3).flat_map(|t| [t[a], t[b], t[c]]).collect() };
    // This fails only for meshes whose data is on the GPU only, which the plugin's meshes never are.
    let _ = mesh.try_insert_indices(Indices::U32(indices));
    !nothing
}

/// Returns the values of an attribute, or `stand_in` for each corner of the triangle of an empty part.
fn whole<T: Copy>(values: &[T], nothing: bool, stand_in: T) -> Vec<T> {
    if nothing { vec![stand_in; 3] } else { values.to_vec() }
}

/// Writes what `changes` and `canvas` tell of a part that is not empty, to a mesh that shows the part before them.
pub(super) fn patch_part(
    mesh: &mut Mesh,
    part: &MeshPart,
    changes: &PartChanges,
    attributes: SlotAttributes,
    space: PartSpace,
    canvas: &StainCanvas,
) {
    let PartChanges { renewed, moved, indices, .. } = changes;
    patch(mesh, Mesh::ATTRIBUTE_POSITION, &part.positions, moved, |p| space.position(p));
    patch(mesh, Mesh::ATTRIBUTE_NORMAL, &part.normals, moved, |n| space.normal(n));
    patch(mesh, Mesh::ATTRIBUTE_TANGENT, &part.tangents, moved, |t| space.tangent(t));
    patch(mesh, Mesh::ATTRIBUTE_UV_0, &part.uvs, renewed, |uv| uv);
    patch(mesh, Mesh::ATTRIBUTE_UV_1, &part.uvs_1, renewed, |uv| uv);
    match canvas.carrier() {
        StainCarrier::Attributes => {
            patch(mesh, ATTRIBUTE_REST, &part.rest, renewed, |p| p);
            patch(mesh, ATTRIBUTE_REST_NORMAL, &part.rest_normals, renewed, |n| n);
            patch(mesh, ATTRIBUTE_STAINS, canvas.stains(), canvas.changed(), |stains| stains);
        }
        StainCarrier::Colors => patch(mesh, Mesh::ATTRIBUTE_COLOR, canvas.colors(), canvas.changed(), |color| color),
        StainCarrier::Nothing => {}
    }
    if attributes.colors && canvas.carrier() != StainCarrier::Colors {
        patch(mesh, Mesh::ATTRIBUTE_COLOR, &part.colors, renewed, |color| color);
    }
    if indices.is_empty() {
        return;
    }
    if let Ok(Some(Indices::U32(values))) = mesh.try_indices_mut_option() {
        values.resize(part.indices.len(), 0);
        let [a, b, c] = space.index_order();
        for range in indices.ranges() {
            for (to, t) in values[range.clone()].chunks_exact_mut(3).zip(part.indices[range].chunks_exact(3)) {
                to.copy_from_slice(&[t[a], t[b], t[c]]);
            }
        }
    }
}

/// Writes the transformed values of some vertices to an attribute, if the mesh has it, and lets it grow with the part.
fn patch<const N: usize>(
    mesh: &mut Mesh,
    attribute: MeshVertexAttribute,
    from: &[[f32; N]],
    ranges: &IndexRanges,
    turn: impl Fn([f32; N]) -> [f32; N],
) where
    VertexAttributeValues: Floats<N>,
{
    if ranges.is_empty() || from.is_empty() {
        return;
    }
    let Ok(Some(values)) = mesh.try_attribute_mut_option(attribute) else { return };
    let Some(values) = values.floats() else { return };
    values.resize(from.len(), [0.0; N]);
    for range in ranges.ranges() {
        for (to, &value) in values[range.clone()].iter_mut().zip(&from[range]) {
            *to = turn(value);
        }
    }
}

/// Values of an attribute with `N` numbers a vertex.
trait Floats<const N: usize> {
    /// Returns the values; `None` if they are of another kind.
    fn floats(&mut self) -> Option<&mut Vec<[f32; N]>>;
}

impl Floats<2> for VertexAttributeValues {
    fn floats(&mut self) -> Option<&mut Vec<[f32; 2]>> {
        if let Self::Float32x2(values) = self { Some(values) } else { None }
    }
}

impl Floats<3> for VertexAttributeValues {
    fn floats(&mut self) -> Option<&mut Vec<[f32; 3]>> {
        if let Self::Float32x3(values) = self { Some(values) } else { None }
    }
}

impl Floats<4> for VertexAttributeValues {
    fn floats(&mut self) -> Option<&mut Vec<[f32; 4]>> {
        if let Self::Float32x4(values) = self { Some(values) } else { None }
    }
}

/// Sets an attribute of a mesh.
pub(super) fn insert(mesh: &mut Mesh, attribute: MeshVertexAttribute, values: impl Into<VertexAttributeValues>) {
    // This fails only for meshes whose data is on the GPU only, which the plugin's meshes never are.
    let _ = mesh.try_insert_attribute(attribute, values);
}

/// Removes an attribute of a mesh, if it has it.
fn remove(mesh: &mut Mesh, attribute: MeshVertexAttribute) {
    // As in `insert`.
    let _ = mesh.try_remove_attribute(attribute);
}
