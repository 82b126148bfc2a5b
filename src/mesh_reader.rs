//! Reads Bevy meshes: builds the [`Surface`] of a prop from them, and the triangles of shelters.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy::{
    math::{Vec2, Vec3, Vec4},
    mesh::{Indices, Mesh, MeshAccessError, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues},
};

use crate::{
    api::error::CoatingFault,
    remesh::MAX_FILM_TRIANGLES,
    rest::Rest,
    surface::{BuildError, Surface},
};

/// Attributes that the mesh of a primitive has itself. The film's mesh gets the same attributes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SlotAttributes {
    /// Whether it has normals.
    pub normals: bool,
    /// Whether it has first texture coordinates.
    pub uvs: bool,
    /// Whether it has second texture coordinates.
    pub uvs_1: bool,
    /// Whether it has tangents.
    pub tangents: bool,
    /// Whether it has vertex colours.
    pub colors: bool,
}

/// Triangles of one primitive and the attributes of their corners, three entries a triangle. An attribute that the mesh
/// does not have is empty.
struct Corners {
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    uvs_1: Vec<Vec2>,
    tangents: Vec<Vec4>,
    colors: Vec<Vec4>,
}

/// Joins the primitives of one prop into its surface, scaled by `scale`, and returns the attributes that each primitive
/// has. Where only some primitives have an attribute, the others get a neutral value.
///
/// If the scale mirrors the prop, the winding of the triangles is reversed, so that they are counter-clockwise seen
/// from outside again. It rests between attributes and between primitives.
///
/// # Errors
/// [`CoatingFault`] for meshes that do not consist of triangles, cannot be read, or have indices out of range.
pub(crate) async fn surface_of(
    meshes: &[Mesh],
    scale: Vec3,
    rest: &mut impl Rest,
) -> Result<(Surface, Vec<SlotAttributes>), CoatingFault> {
    let mut surface = Surface::default();
    let mut slots = Vec::with_capacity(meshes.len());
    let mirrored = scale.x * scale.y * scale.z < 0.0;
    for (slot, mesh) in (0..).zip(meshes) {
        let positions = positions_of(mesh)?;
        let first_vertex = first_of(&surface, positions.len())?;
        let first_triangle = surface.triangles.len();
        let mut corners = corners_of(mesh, positions.len(), rest).await?;
        corners.scale(scale);
        if mirrored {
            corners.reverse_winding();
        }
        // Numbers of neutral values for the earlier primitives, and for this one, where they lack an attribute.
        let before = first_triangle * 3;
        let here = corners.triangles.len() * 3;
        surface.positions.extend(positions.iter().map(|&p| Vec3::from_array(p) * scale));
        surface.triangles.extend(corners.triangles.iter().map(|t| t.map(|v| v + first_vertex)));
        surface.slots.resize(surface.triangles.len(), slot);
        slots.push(SlotAttributes {
            normals: append(&mut surface.normals, corners.normals, before, here, Vec3::ZERO),
            uvs: append(&mut surface.uvs, corners.uvs, before, here, Vec2::ZERO),
            uvs_1: append(&mut surface.uvs_1, corners.uvs_1, before, here, Vec2::ZERO),
            tangents: append(&mut surface.tangents, corners.tangents, before, here, Vec4::W),
            colors: append(&mut surface.colors, corners.colors, before, here, Vec4::ONE),
        });
        rest.rest().await;
    }
    Ok((surface, slots))
}

/// Returns the index that the first of so many more vertices of a surface gets.
///
/// # Errors
/// [`BuildError::TooLarge`] if not all of them can be numbered: films of so many vertices would be too large, too.
fn first_of(surface: &Surface, more: usize) -> Result<u32, BuildError> {
    let first = surface.positions.len();
    let found = first.saturating_add(more);
    let numbers = u32::try_from(first).ok().zip(u32::try_from(found).ok());
    numbers.map(|(first, _)| first).ok_or(BuildError::TooLarge { found, limit: MAX_FILM_TRIANGLES })
}

/// Returns the positions and triangles of a mesh.
///
/// # Errors
/// [`CoatingFault`] for meshes that do not consist of triangles or cannot be read.
pub(crate) fn shape_of(mesh: &Mesh) -> Result<(Vec<[f32; 3]>, Vec<[u32; 3]>), CoatingFault> {
    let positions = positions_of(mesh)?;
    Ok((positions.to_vec(), triangles_of(mesh, positions.len())?))
}

/// Returns the area of a mesh in square metres, if `scale` leads from it to metres; 0 for a mesh that cannot
/// be read.
pub(crate) fn area_of(mesh: &Mesh, scale: Vec3) -> f64 {
    let Ok((positions, triangles)) = shape_of(mesh) else { return 0.0 };
    let positions = positions.into_iter().map(|p| Vec3::from_array(p) * scale).collect();
    Surface { positions, triangles, ..Surface::default() }.area()
}

/// Appends `values` to `all` and returns whether there are any. Without values it appends `here` times `neutral` if
/// earlier primitives have some; `before` is the length that `all` should have.
fn append<T: Copy>(all: &mut Vec<T>, values: Vec<T>, before: usize, here: usize, neutral: T) -> bool {
    let present = !values.is_empty();
    if present {
        all.resize(before, neutral);
        all.extend(values);
    } else if !all.is_empty() {
        all.resize(before + here, neutral);
    }
    present
}

impl Corners {
    /// Transforms normals and tangents by `scale`. An even positive scale leaves their bits unchanged.
    fn scale(&mut self, scale: Vec3) {
        if scale.x == scale.y && scale.y == scale.z && scale.x > 0.0 {
            return;
        }
        for normal in &mut self.normals {
            *normal = (*normal / scale).normalize_or_zero();
        }
        for tangent in &mut self.tangents {
            *tangent = (tangent.truncate() * scale).normalize_or_zero().extend(tangent.w);
        }
    }

    /// Reverses the winding of every triangle.
    fn reverse_winding(&mut self) {
        fn swap<T>(values: &mut [T]) {
            for corners in values.chunks_exact_mut(3) {
                corners.swap(1, 2);
            }
        }
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        swap(&mut self.normals);
        swap(&mut self.uvs);
        swap(&mut self.uvs_1);
        swap(&mut self.tangents);
        swap(&mut self.colors);
    }
}

/// Returns the positions of a mesh.
fn positions_of(mesh: &Mesh) -> Result<&[[f32; 3]], CoatingFault> {
    match mesh.try_attribute(Mesh::ATTRIBUTE_POSITION) {
        Ok(VertexAttributeValues::Float32x3(positions)) => Ok(positions),
        Ok(other) => Err(format_fault("positions", other, "Float32x3")),
        Err(MeshAccessError::NotFound) => Err(CoatingFault::NoPositions),
        Err(MeshAccessError::ExtractedToRenderWorld) => Err(CoatingFault::RenderWorldOnly),
    }
}

/// Reads the triangles of a mesh and the attributes of their corners, and checks the indices.
async fn corners_of(mesh: &Mesh, vertices: usize, rest: &mut impl Rest) -> Result<Corners, CoatingFault> {
    let triangles = triangles_of(mesh, vertices)?;
    for (triangle, corners) in (0..).zip(&triangles) {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(BuildError::IndexOutOfRange { triangle, vertex, vertices }.into());
        }
    }
    let spread = |attribute, name, expected, components| {
        let values = floats_of(mesh, attribute, name, expected, components)?;
        if !values.is_empty() && values.len() != vertices {
            let found = values.len();
            return Err(CoatingFault::from(BuildError::AttributeLength { attribute: name, found, expected: vertices }));
        }
        // The indices have been checked against the number of vertices, which is the number of values.
        Ok(if values.is_empty() {
            Vec::new()
        } else {
            let value = |&v: &u32| values.get(v as usize).copied().unwrap_or_default();
            triangles.iter().flatten().map(value).collect::<Vec<Vec4>>()
        })
    };
    rest.rest().await;
    let normals = spread(Mesh::ATTRIBUTE_NORMAL, "normals", "three floats or normalised integers", 3)?;
    let normals = normals.iter().map(|v| v.truncate()).collect();
    rest.rest().await;
    let uvs = spread(Mesh::ATTRIBUTE_UV_0, "texture coordinates", "two floats or normalised integers", 2)?;
    let uvs = uvs.iter().map(|v| Vec2::new(v.x, v.y)).collect();
    rest.rest().await;
    let uvs_1 = spread(Mesh::ATTRIBUTE_UV_1, "second texture coordinates", "two floats or normalised integers", 2)?;
    let uvs_1 = uvs_1.iter().map(|v| Vec2::new(v.x, v.y)).collect();
    rest.rest().await;
    let tangents = spread(Mesh::ATTRIBUTE_TANGENT, "tangents", "four floats or normalised integers", 4)?;
    rest.rest().await;
    let colors = spread(Mesh::ATTRIBUTE_COLOR, "vertex colours", "three or four floats or normalised integers", 3)?;
    rest.rest().await;
    Ok(Corners { triangles, normals, uvs, uvs_1, tangents, colors })
}

/// Returns the triangles of a list or strip, with or without indices. Indices left over at the end of a list are
/// ignored, as they are when the mesh is drawn.
fn triangles_of(mesh: &Mesh, vertices: usize) -> Result<Vec<[u32; 3]>, CoatingFault> {
    let indices = match mesh.try_indices_option() {
        Ok(Some(Indices::U32(indices))) => indices.iter().map(|&i| (i != u32::MAX).then_some(i)).collect(),
        Ok(Some(Indices::U16(indices))) => indices.iter().map(|&i| (i != u16::MAX).then_some(u32::from(i))).collect(),
        Ok(None) => (0..).take(vertices).map(Some).collect::<Vec<_>>(),
        Err(_) => return Err(CoatingFault::RenderWorldOnly),
    };
    match mesh.primitive_topology() {
        // The highest index restarts strips only; in a list it is an index out of range.
        PrimitiveTopology::TriangleList => {
            Ok(indices.as_chunks::<3>().0.iter().map(|t| t.map(|i| i.unwrap_or(u32::MAX))).collect())
        }
        PrimitiveTopology::TriangleStrip => Ok(strip_triangles(&indices)),
        other => Err(CoatingFault::NotTriangles(other)),
    }
}

/// Returns the triangles of a strip; the winding of every second one is reversed. `None` begins a new strip.
fn strip_triangles(indices: &[Option<u32>]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(indices.len());
    for strip in indices.split(Option::is_none) {
        for (i, window) in strip.array_windows().enumerate() {
            if let [Some(a), Some(b), Some(c)] = *window {
                triangles.push(if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        }
    }
    triangles
}

/// Returns an attribute as floats; empty if the mesh does not have it. Missing components are filled from (0, 0, 0, 1).
///
/// # Errors
/// [`CoatingFault::Format`] if the format cannot be read or has fewer than `components` components.
fn floats_of(
    mesh: &Mesh,
    attribute: MeshVertexAttribute,
    name: &'static str,
    expected: &'static str,
    components: usize,
) -> Result<Vec<Vec4>, CoatingFault> {
    use VertexAttributeValues as V;
    let values = match mesh.try_attribute_option(attribute) {
        Ok(Some(values)) => values,
        Ok(None) => return Ok(Vec::new()),
        Err(_) => return Err(CoatingFault::RenderWorldOnly),
    };
    let (found, floats) = match values {
        V::Float32x2(v) => (2, v.iter().map(|&[x, y]| Vec4::new(x, y, 0.0, 1.0)).collect()),
        V::Float32x3(v) => (3, v.iter().map(|&[x, y, z]| Vec4::new(x, y, z, 1.0)).collect()),
        V::Float32x4(v) => (4, v.iter().map(|&v| Vec4::from_array(v)).collect()),
        V::Float16x2(v) => (2, pairs(v, |x| x.to_f32())),
        V::Float16x4(v) => (4, quads(v, |x| x.to_f32())),
        V::Unorm8x2(v) => (2, pairs(v, |x| f32::from(x) / 255.0)),
        V::Unorm8x4(v) => (4, quads(v, |x| f32::from(x) / 255.0)),
        V::Unorm16x2(v) => (2, pairs(v, |x| f32::from(x) / 65535.0)),
        V::Unorm16x4(v) => (4, quads(v, |x| f32::from(x) / 65535.0)),
        V::Snorm8x2(v) => (2, pairs(v, |x| (f32::from(x) / 127.0).max(-1.0))),
        V::Snorm8x4(v) => (4, quads(v, |x| (f32::from(x) / 127.0).max(-1.0))),
        V::Snorm16x2(v) => (2, pairs(v, |x| (f32::from(x) / 32767.0).max(-1.0))),
        V::Snorm16x4(v) => (4, quads(v, |x| (f32::from(x) / 32767.0).max(-1.0))),
        other => return Err(format_fault(name, other, expected)),
    };
    if found < components {
        return Err(format_fault(name, values, expected));
    }
    Ok(floats)
}

/// Converts values of two components.
fn pairs<T: Copy>(values: &[[T; 2]], float: impl Fn(T) -> f32) -> Vec<Vec4> {
    values.iter().map(|&[x, y]| Vec4::new(float(x), float(y), 0.0, 1.0)).collect()
}

/// Converts values of four components.
fn quads<T: Copy>(values: &[[T; 4]], float: impl Fn(T) -> f32) -> Vec<Vec4> {
    values.iter().map(|&v| Vec4::from_array(v.map(&float))).collect()
}

/// Returns the fault of an attribute with the wrong format.
fn format_fault(attribute: &'static str, found: &VertexAttributeValues, expected: &'static str) -> CoatingFault {
    let found = format!("{:?}", bevy::mesh::VertexFormat::from(found));
    CoatingFault::Format { attribute, found, expected }
}
