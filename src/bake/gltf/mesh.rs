//! Reads the primitives of a mesh into one surface: the paint does not care where one material ends.

use bevy_math::{DMat3, DMat4, DVec3, Vec2, Vec3, Vec4};

use super::{
    GltfError,
    container::Container,
    document::{Mesh, Primitive, lookup},
};
use crate::bake::model::{ModelMesh, Slot, centred};

/// Most triangles a file may put into its scene.
pub const MAX_TRIANGLES: usize = 1 << 24;

/// A mesh in the space of the scene.
pub struct Placed {
    pub mesh: ModelMesh,
    /// Primitives of points or lines, which were left out.
    pub skipped: usize,
    /// Whether there are morph targets.
    pub morphed: bool,
    /// Whether there are texture coordinates past the second.
    pub more_uvs: bool,
}

/// Places mesh `index` under `transform`. `node` is its name in messages.
pub fn place(container: &Container, index: usize, transform: DMat4, node: &str) -> Result<Placed, GltfError> {
    let mesh = lookup(&container.document.meshes, index, "mesh", &format!("node {node}"))?;
    let mut placed = Placed { mesh: ModelMesh::default(), skipped: 0, morphed: false, more_uvs: false };
    let primitives = read_primitives(container, index, mesh, &mut placed)?;
    let surface = &mut placed.mesh.surface;
    let space = Space::new(transform);

    // Primitives often share their vertices: each set of positions is taken once.
    let mut bases: Vec<(usize, u32)> = Vec::new();
    let mut positions: Vec<DVec3> = Vec::new();
    for primitive in &primitives {
        if bases.iter().all(|&(accessor, _)| accessor != primitive.position) {
            bases.push((primitive.position, positions.len() as u32));
            positions.extend(primitive.positions.iter().map(|&p| space.point(p)));
        }
    }
    (surface.positions, placed.mesh.origin) = centred(&positions);

    let some = |has: fn(&Data) -> bool| primitives.iter().any(has);
    let (normals, tangents) = (some(|p| p.normals.is_some()), some(|p| p.tangents.is_some()));
    let (uvs, uvs_1, colors) = (some(|p| p.uvs.is_some()), some(|p| p.uvs_1.is_some()), some(|p| p.colors.is_some()));
    for (slot, primitive) in primitives.iter().enumerate() {
        let base = bases.iter().find(|&&(accessor, _)| accessor == primitive.position).map_or(0, |&(_, base)| base);
        for &triangle in &primitive.triangles {
            let local = if space.mirrored { [triangle[0], triangle[2], triangle[1]] } else { triangle };
            let corners = local.map(|v| v as usize);
            let vertices = local.map(|v| base + v);
            let points = vertices.map(|v| surface.positions[v as usize]);
            // Vertices that no triangle uses may be anywhere.
            if let Some(i) = points.iter().position(|p| !p.is_finite()) {
                return Err(GltfError::NonFinite { node: node.into(), vertex: vertices[i] as usize });
            }
            let flat = (points[1] - points[0]).cross(points[2] - points[0]).normalize_or(Vec3::Y);
            surface.triangles.push(vertices);
            surface.slots.push(slot as u32);
            if normals {
                surface.normals.extend(corners.map(|v| match &primitive.normals {
                    Some(normals) => space.normal(normals[v].into()).unwrap_or(flat),
                    None => flat,
                }));
            }
            if tangents {
                surface.tangents.extend(corners.map(|v| match &primitive.tangents {
                    Some(tangents) => space.tangent(tangents[v].into(), flat),
                    None => flat.any_orthonormal_vector().extend(1.0),
                }));
            }
            // Coordinates and colours that are no numbers would spread into the whole film.
            let uv = |uvs: &Option<Vec<[f32; 2]>>, v: usize| {
                uvs.as_ref().map(|uvs| Vec2::from(uvs[v])).filter(|uv| uv.is_finite()).unwrap_or_default()
            };
            if uvs {
                surface.uvs.extend(corners.map(|v| uv(&primitive.uvs, v)));
            }
            if uvs_1 {
                surface.uvs_1.extend(corners.map(|v| uv(&primitive.uvs_1, v)));
            }
            if colors {
                let color = |v: usize| primitive.colors.as_ref().map(|colors| Vec4::from(colors[v]));
                let valid = |c: Vec4| c.is_finite().then(|| c.clamp(Vec4::ZERO, Vec4::ONE));
                surface.colors.extend(corners.map(|v| color(v).and_then(valid).unwrap_or(Vec4::ONE)));
            }
        }
    }
    placed.mesh.slots = primitives.iter().map(Data::slot).collect();
    Ok(placed)
}

/// One primitive of triangles, in the mesh's own space.
struct Data {
    material: Option<usize>,
    /// Accessor of the positions.
    position: usize,
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    tangents: Option<Vec<[f32; 4]>>,
    uvs: Option<Vec<[f32; 2]>>,
    uvs_1: Option<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 4]>>,
}

impl Data {
    fn slot(&self) -> Slot {
        Slot {
            material: self.material,
            uvs: self.uvs.is_some(),
            uvs_1: self.uvs_1.is_some(),
            tangents: self.tangents.is_some(),
            colors: self.colors.is_some(),
        }
    }
}

fn read_primitives(
    container: &Container,
    index: usize,
    mesh: &Mesh,
    placed: &mut Placed,
) -> Result<Vec<Data>, GltfError> {
    let mut primitives = Vec::new();
    let mut total = 0;
    for (i, primitive) in mesh.primitives.iter().enumerate() {
        placed.morphed |= !primitive.targets.is_empty();
        placed.more_uvs |= primitive.attributes.texcoord_2.is_some();
        let mode = primitive.mode.unwrap_or(4);
        if !(4..=6).contains(&mode) {
            placed.skipped += 1;
            continue;
        }
        let data = read_primitive(container, (index, i), primitive, mode)?;
        total += data.triangles.len();
        if total > MAX_TRIANGLES {
            let what = format!("mesh {index}");
            return Err(GltfError::TooMany { what, found: total as u64, limit: MAX_TRIANGLES as u64 });
        }
        primitives.push(data);
    }
    Ok(primitives)
}

fn read_primitive(
    container: &Container,
    (mesh, index): (usize, usize),
    primitive: &Primitive,
    mode: u32,
) -> Result<Data, GltfError> {
    let attributes = &primitive.attributes;
    let position = attributes.position.ok_or(GltfError::NoPositions { mesh, primitive: index })?;
    let positions = container.vectors::<3>(position, "positions")?;
    let vertices = positions.len();
    if let Some(material) = primitive.material {
        lookup(&container.document.materials, material, "material", &format!("mesh {mesh}"))?;
    }
    let list = match primitive.indices {
        Some(indices) => container.indices(indices)?,
        None => (0..vertices as u32).collect(),
    };
    if let Some(&found) = list.iter().find(|&&v| v as usize >= vertices) {
        return Err(GltfError::IndexOutOfRange { mesh, primitive: index, index: found, vertices });
    }
    // An attribute has one element a vertex.
    fn whole<T>(found: Vec<T>, accessor: usize, what: &'static str, vertices: usize) -> Result<Vec<T>, GltfError> {
        if found.len() < vertices {
            let cause = format!("it has {} elements for {vertices} vertices", found.len());
            return Err(GltfError::Accessor { accessor, what, cause });
        }
        Ok(found)
    }
    fn vectors<const N: usize>(
        container: &Container,
        accessor: Option<usize>,
        what: &'static str,
        vertices: usize,
    ) -> Result<Option<Vec<[f32; N]>>, GltfError> {
        accessor.map(|a| whole(container.vectors::<N>(a, what)?, a, what, vertices)).transpose()
    }
    Ok(Data {
        material: primitive.material,
        position,
        triangles: triangles(&list, mode),
        normals: vectors(container, attributes.normal, "normals", vertices)?,
        tangents: vectors(container, attributes.tangent, "tangents", vertices)?,
        uvs: vectors(container, attributes.texcoord_0, "texture coordinates", vertices)?,
        uvs_1: vectors(container, attributes.texcoord_1, "texture coordinates", vertices)?,
        colors: attributes.color_0.map(|a| whole(container.colors(a)?, a, "vertex colours", vertices)).transpose()?,
        positions,
    })
}

/// Triangles of a list (mode 4), strip (5) or fan (6), as glTF 2.0 section 3.7.2.1 defines them.
fn triangles(list: &[u32], mode: u32) -> Vec<[u32; 3]> {
    match mode {
        5 => list
            .windows(3)
            .enumerate()
            .map(|(i, v)| if i % 2 == 0 { [v[0], v[1], v[2]] } else { [v[0], v[2], v[1]] })
            .collect(),
        6 => match list.split_first() {
            Some((&first, rest)) => rest.windows(2).map(|v| [v[0], v[1], first]).collect(),
            None => Vec::new(),
        },
        _ => list.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect(),
    }
}

/// From the mesh's space to the scene's.
struct Space {
    transform: DMat4,
    /// For normals: the cofactors, which need no inverse and so hold for flattened meshes too.
    cofactors: DMat3,
    mirrored: bool,
}

impl Space {
    fn new(transform: DMat4) -> Self {
        let m = DMat3::from_mat4(transform);
        let mirrored = m.determinant() < 0.0;
        let sign = if mirrored { -1.0 } else { 1.0 };
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        Self { transform, cofactors, mirrored }
    }

    fn point(&self, point: [f32; 3]) -> DVec3 {
        self.transform.transform_point3(DVec3::from(point.map(f64::from)))
    }

    fn normal(&self, normal: Vec3) -> Option<Vec3> {
        (self.cofactors * normal.as_dvec3()).try_normalize().map(|n| n.as_vec3())
    }

    fn tangent(&self, tangent: Vec4, normal: Vec3) -> Vec4 {
        let direction = self.transform.transform_vector3(tangent.truncate().as_dvec3()).as_vec3();
        let hand = if (tangent.w < 0.0) != self.mirrored { -1.0 } else { 1.0 };
        direction.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector()).extend(hand)
    }
}
