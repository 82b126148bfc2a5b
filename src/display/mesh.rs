//! From the arrays of a shown part to a mesh.

use bevy::{
    asset::RenderAssetUsages,
    math::Vec3,
    mesh::{Indices, Mesh, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues, VertexFormat},
};

use super::FilmPaint;
use crate::{
    appearance::{MeshPart, shading::StainPart},
    mesh_reader::SlotAttributes,
};
/// Stains of each vertex of a film's meshes: layers of rust (at most one), dust, moisture, and how far the metal has rusted there
/// ([`MeshPart::stains`]). Present while they are shown by a material.
pub const ATTRIBUTE_STAINS: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_Stains", 0x636f_6174_7374_6169, VertexFormat::Float32x4);

/// Where each vertex of a film's meshes lies at rest, in metres in the film's space ([`MeshPart::rest`]). Present while
/// stains are shown by a material.
pub const ATTRIBUTE_REST: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_Rest", 0x636f_6174_7265_7374, VertexFormat::Float32x3);

/// Unit normal of each vertex of a film's meshes at rest ([`MeshPart::rest_normals`]). Present while stains are shown by a
/// material.
pub const ATTRIBUTE_REST_NORMAL: MeshVertexAttribute =
    MeshVertexAttribute::new("Coating_RestNormal", 0x636f_6174_6e6f_726d, VertexFormat::Float32x3);

/// What the stains of a part's mesh go into.
#[derive(Clone, Copy)]
pub(super) enum StainCarrier {
    /// [`ATTRIBUTE_STAINS`], [`ATTRIBUTE_REST`] and [`ATTRIBUTE_REST_NORMAL`].
    Attributes,
    /// The vertices' colours.
    Colors,
    /// Nothing.
    Nothing,
}

/// How a part's stains get into its mesh.
#[derive(Clone, Copy)]
pub(super) struct StainWriter<'a> {
    pub part: StainPart,
    pub paint: &'a FilmPaint,
    pub carrier: StainCarrier,
    /// Mean distance between vertices, in metres.
    pub edge: f32,
}

/// Turns arrays in the film's space, which has the prop's world scale applied, into those of the prop's mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartSpace {
    scale: Vec3,
    /// Whether directions need turning, too.
    skewed: bool,
    mirrored: bool,
}

impl PartSpace {
    pub fn new(scale: Vec3) -> Self {
        Self {
            scale,
            skewed: scale.x != scale.y || scale.y != scale.z || scale.x < 0.0,
            mirrored: scale.x * scale.y * scale.z < 0.0,
        }
    }

    /// Whether the film is a mirror image of the prop's mesh.
    #[cfg(feature = "render")]
    pub fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    fn position(&self, p: [f32; 3]) -> [f32; 3] {
        (Vec3::from_array(p) / self.scale).to_array()
    }

    /// Normals go over with the inverse transpose, which undoes what they came with.
    fn normal(&self, n: [f32; 3]) -> [f32; 3] {
        if self.skewed { (Vec3::from_array(n) * self.scale).normalize_or_zero().to_array() } else { n }
    }

    fn tangent(&self, [x, y, z, w]: [f32; 4]) -> [f32; 4] {
        if self.skewed {
            (Vec3::new(x, y, z) / self.scale).normalize_or_zero().extend(w).to_array()
        } else {
            [x, y, z, w]
        }
    }

    fn index_order(&self) -> [usize; 3] {
        if self.mirrored { [0, 2, 1] } else { [0, 1, 2] }
    }
}

/// An empty mesh that stays in the main world, to be written again and again.
pub(super) fn new_mesh() -> Mesh {
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::MAIN_WORLD | RenderAssetUsages::RENDER_WORLD)
}

/// Writes a whole part. Of the attributes only those that the prop's own mesh has are written, normals always, and what
/// carries the stains. Where nothing is left, one triangle without area stands in: a mesh must not be empty.
pub(super) fn write_part(
    mesh: &mut Mesh,
    part: &MeshPart,
    attributes: SlotAttributes,
    space: PartSpace,
    stains: StainWriter,
) {
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
    if matches!(stains.carrier, StainCarrier::Attributes) {
        insert(mesh, ATTRIBUTE_REST, whole(&part.rest, nothing, [0.0; 3]));
        insert(mesh, ATTRIBUTE_REST_NORMAL, whole(&part.rest_normals, nothing, [0.0, 0.0, 1.0]));
    } else {
        remove(mesh, ATTRIBUTE_REST);
        remove(mesh, ATTRIBUTE_REST_NORMAL);
        remove(mesh, ATTRIBUTE_STAINS);
    }
    write_stains(mesh, part, stains);
    let [a, b, c] = space.index_order();
    let indices =
        if nothing { vec![0, 1, 2] } else { part.indices.chunks_exact(3).flat_map(|t| [t[a], t[b], t[c]]).collect() };
    // Fails only for meshes that have been handed over to the GPU; ours stay.
    let _ = mesh.try_insert_indices(Indices::U32(indices));
}

/// Writes the stains of a part whose vertices are those of the last [`write_part`].
pub(super) fn write_stains(mesh: &mut Mesh, part: &MeshPart, stains: StainWriter) {
    let nothing = part.is_empty();
    match stains.carrier {
        StainCarrier::Attributes => insert(mesh, ATTRIBUTE_STAINS, whole(&part.stains, nothing, [0.0; 4])),
        StainCarrier::Colors => {
            let own = |i| part.colors.get(i).copied().unwrap_or([1.0; 4]);
            let color = |i| Some(stains.paint.color(stains.part, own(i), &part.sample(i)?, stains.edge));
            let colors: Vec<_> = (0..part.positions.len()).filter_map(color).collect();
            insert(mesh, Mesh::ATTRIBUTE_COLOR, whole(&colors, nothing, [1.0; 4]));
        }
        StainCarrier::Nothing => {}
    }
}

/// Attributes of a part that has nothing left are those of the triangle that stands in.
fn whole<T: Copy>(values: &[T], nothing: bool, stand_in: T) -> Vec<T> {
    if nothing { vec![stand_in; 3] } else { values.to_vec() }
}

/// Writes positions, normals and tangents of a part whose vertices are those of the last [`write_part`].
pub(super) fn move_part(mesh: &mut Mesh, part: &MeshPart, space: PartSpace) {
    if part.is_empty() {
        return;
    }
    if let Ok(VertexAttributeValues::Float32x3(values)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_POSITION) {
        renew(values, &part.positions, |p| space.position(p));
    }
    if let Ok(VertexAttributeValues::Float32x3(values)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_NORMAL) {
        renew(values, &part.normals, |n| space.normal(n));
    }
    if let Ok(Some(VertexAttributeValues::Float32x4(values))) = mesh.try_attribute_mut_option(Mesh::ATTRIBUTE_TANGENT) {
        renew(values, &part.tangents, |t| space.tangent(t));
    }
}

fn renew<T: Copy>(values: &mut Vec<T>, from: &[T], turn: impl Fn(T) -> T) {
    values.clear();
    values.extend(from.iter().map(|&value| turn(value)));
}

fn insert(mesh: &mut Mesh, attribute: MeshVertexAttribute, values: impl Into<VertexAttributeValues>) {
    // Fails only for meshes that have been handed over to the GPU; ours stay.
    let _ = mesh.try_insert_attribute(attribute, values);
}

fn remove(mesh: &mut Mesh, attribute: MeshVertexAttribute) {
    // As above.
    let _ = mesh.try_remove_attribute(attribute);
}
