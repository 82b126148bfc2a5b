//! Reads the primitives of a mesh into one surface: the paint does not care where one material ends.

use std::{collections::BTreeMap, rc::Rc};

use bevy_math::{DMat3, DMat4, DVec3, Vec2, Vec3, Vec4};

use super::{
    GltfError,
    cache::Cache,
    coordinates::{Fitted, Fitting},
    document::{Mesh, Primitive, lookup},
};
use crate::bake::model::{MaterialLibrary, ModelMesh, Slot, centred};

/// Most triangles a file may put into its scene.
pub const MAX_TRIANGLES: usize = 1 << 24;

/// A mesh in the space of the scene.
#[derive(Default)]
pub struct Placed {
    pub mesh: ModelMesh,
    /// Index in the mesh of the primitive of each slot.
    pub primitives: Vec<Option<usize>>,
    /// Whether there are morph targets.
    pub morphed: bool,
    /// Whether there are attributes that are left out, and whether they are texture coordinates.
    pub more_attributes: bool,
    pub more_uvs: bool,
    /// Textures for which there are no coordinates.
    pub without_coordinates: usize,
}

/// Reads meshes and places them.
pub struct Placing<'a> {
    pub cache: Cache<'a>,
    pub fitting: Fitting,
}

impl Placing<'_> {
    /// Places mesh `index` under `transform`. `node` is its name in messages. Materials that have to be fitted are
    /// added to the library.
    pub fn place(
        &mut self,
        library: &mut MaterialLibrary,
        index: usize,
        transform: DMat4,
        node: &str,
    ) -> Result<Placed, GltfError> {
        let document = &self.cache.container.document;
        let mesh = lookup(&document.meshes, index, "mesh", &format!("node {node}"))?;
        let mut placed = Placed::default();
        let primitives = self.read_primitives(library, index, mesh, &mut placed)?;
        fill(&mut placed, &primitives, transform, node)?;
        Ok(placed)
    }

    fn read_primitives(
        &mut self,
        library: &mut MaterialLibrary,
        index: usize,
        mesh: &Mesh,
        placed: &mut Placed,
    ) -> Result<Vec<Data>, GltfError> {
        let mut primitives = Vec::new();
        let mut total = 0;
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let mode = primitive.mode.unwrap_or(4);
            // Points and lines go on as they are.
            if !(4..=6).contains(&mode) {
                continue;
            }
            let attributes = &primitive.attributes;
            if let Some(material) = primitive.material {
                lookup(&self.cache.container.document.materials, material, "material", &format!("mesh {index}"))?;
            }
            let fitted = self.fitting.fit(library, primitive.material, attributes.sets());
            placed.without_coordinates += fitted.left_out;
            placed.morphed |= !primitive.targets.is_empty();
            placed.more_uvs |= attributes.sets().into_iter().any(|set| !fitted.sets.contains(&Some(set)));
            placed.more_attributes |= attributes.has_more();
            let data = read_primitive(&self.cache, (index, i), primitive, mode, fitted)?;
            total += data.triangles.len();
            if total > MAX_TRIANGLES {
                let what = format!("mesh {index}");
                return Err(GltfError::TooMany { what, found: total as u64, limit: MAX_TRIANGLES as u64 });
            }
            primitives.push(data);
            placed.primitives.push(Some(i));
        }
        Ok(primitives)
    }
}

/// Moves primitives into the space of the scene, as one surface.
fn fill(placed: &mut Placed, primitives: &[Data], transform: DMat4, node: &str) -> Result<(), GltfError> {
    let surface = &mut placed.mesh.surface;
    let space = Space::new(transform);

    // Primitives often share their vertices: each set of positions is taken once.
    let sets = PositionSets::new(primitives, node)?;
    let positions: Vec<DVec3> = sets.positions(primitives).map(|p| space.point(p)).collect();
    (surface.positions, placed.mesh.origin) = centred(&positions);

    let some = |has: fn(&Data) -> bool| primitives.iter().any(has);
    let (normals, tangents) = (some(|p| p.normals.is_some()), some(|p| p.tangents.is_some()));
    let (uvs, uvs_1, colors) = (some(|p| p.uvs.is_some()), some(|p| p.uvs_1.is_some()), some(|p| p.colors.is_some()));
    for (slot, primitive) in (0..).zip(primitives) {
        for &triangle in &primitive.triangles {
            let local = if space.mirrored { [triangle[0], triangle[2], triangle[1]] } else { triangle };
            let corners = local.map(|v| v as usize);
            let vertices = local.map(|v| sets.vertex(primitive.position, v));
            let points = vertices.map(|v| surface.positions.get(v as usize).copied().unwrap_or(Vec3::NAN));
            // Vertices that no triangle uses may be anywhere.
            if let Some((vertex, _)) = vertices.into_iter().zip(points).find(|(_, p)| !p.is_finite()) {
                return Err(GltfError::NonFinite { node: node.into(), vertex: vertex as usize });
            }
            let flat = (points[1] - points[0]).cross(points[2] - points[0]).normalize_or(Vec3::Y);
            surface.triangles.push(vertices);
            surface.slots.push(slot);
            if normals {
                surface.normals.extend(corners.map(|v| match primitive.normals.as_ref().and_then(|n| n.get(v)) {
                    Some(&normal) => space.normal(normal.into()).unwrap_or(flat),
                    None => flat,
                }));
            }
            if tangents {
                surface.tangents.extend(corners.map(|v| match primitive.tangents.as_ref().and_then(|t| t.get(v)) {
                    Some(&tangent) => space.tangent(tangent.into(), flat),
                    None => flat.any_orthonormal_vector().extend(1.0),
                }));
            }
            // Coordinates and colours that are no numbers would spread into the whole film.
            let uv = |uvs: &Option<Rc<[[f32; 2]]>>, v: usize| {
                let uv = uvs.as_ref().and_then(|uvs| uvs.get(v)).copied().map(Vec2::from);
                uv.filter(|uv| uv.is_finite()).unwrap_or_default()
            };
            if uvs {
                surface.uvs.extend(corners.map(|v| uv(&primitive.uvs, v)));
            }
            if uvs_1 {
                surface.uvs_1.extend(corners.map(|v| uv(&primitive.uvs_1, v)));
            }
            if colors {
                let color = |v: usize| Some(Vec4::from(*primitive.colors.as_ref()?.get(v)?));
                let valid = |c: Vec4| c.is_finite().then(|| c.clamp(Vec4::ZERO, Vec4::ONE));
                surface.colors.extend(corners.map(|v| color(v).and_then(valid).unwrap_or(Vec4::ONE)));
            }
        }
    }
    placed.mesh.slots = primitives.iter().map(Data::slot).collect();
    Ok(())
}

/// One primitive of triangles, in the mesh's own space.
struct Data {
    material: Option<usize>,
    /// Accessor of the positions.
    position: usize,
    positions: Rc<[[f32; 3]]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Rc<[[f32; 3]]>>,
    tangents: Option<Rc<[[f32; 4]]>>,
    uvs: Option<Rc<[[f32; 2]]>>,
    uvs_1: Option<Rc<[[f32; 2]]>>,
    colors: Option<Rc<[[f32; 4]]>>,
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

fn read_primitive(
    cache: &Cache,
    (mesh, index): (usize, usize),
    primitive: &Primitive,
    mode: u32,
    fitted: Fitted,
) -> Result<Data, GltfError> {
    let attributes = &primitive.attributes;
    let position = attributes.get("POSITION").ok_or(GltfError::NoPositions { mesh, primitive: index })?;
    let positions = cache.triples(position, "positions")?;
    let vertices = positions.len();
    let list = match primitive.indices {
        Some(indices) => cache.indices(indices)?,
        None => (0..).take(vertices).collect(),
    };
    if let Some(&found) = list.iter().find(|&&v| v as usize >= vertices) {
        return Err(GltfError::IndexOutOfRange { mesh, primitive: index, index: found, vertices });
    }
    // An attribute has one element a vertex.
    fn whole<T>(found: Rc<[T]>, accessor: usize, what: &'static str, vertices: usize) -> Result<Rc<[T]>, GltfError> {
        if found.len() < vertices {
            let cause = format!("it has {} elements for {vertices} vertices", found.len());
            return Err(GltfError::Accessor { accessor, what, cause });
        }
        Ok(found)
    }
    let pairs = |set: Option<usize>| -> Result<Option<Rc<[[f32; 2]]>>, GltfError> {
        let what = "texture coordinates";
        let accessor = set.and_then(|set| attributes.set(set));
        accessor.map(|a| whole(cache.pairs(a, what)?, a, what, vertices)).transpose()
    };
    let (normal, tangent, color) = (attributes.get("NORMAL"), attributes.get("TANGENT"), attributes.get("COLOR_0"));
    let tangents = "tangents";
    let colors = "vertex colours";
    Ok(Data {
        material: fitted.material,
        position,
        triangles: triangles(&list, mode),
        normals: normal.map(|a| whole(cache.triples(a, "normals")?, a, "normals", vertices)).transpose()?,
        tangents: tangent.map(|a| whole(cache.quadruples(a, tangents)?, a, tangents, vertices)).transpose()?,
        uvs: pairs(fitted.sets[0])?,
        uvs_1: pairs(fitted.sets[1])?,
        colors: color.map(|a| whole(cache.colors(a, colors)?, a, colors, vertices)).transpose()?,
        positions,
    })
}

/// The sets of positions that primitives have, one after the other.
struct PositionSets(BTreeMap<usize, PositionSet>);

/// One set of positions.
struct PositionSet {
    /// A primitive that has it.
    primitive: usize,
    /// Place of its first vertex.
    base: u32,
    /// Vertices that are taken, and the place of each among them; empty if all are.
    used: Vec<u32>,
    places: Vec<u32>,
}

impl PositionSets {
    /// Takes whole sets, but for those that primitives use less than half of: many meshes may share one large set.
    /// `node` is named where there are more than can be numbered.
    fn new(primitives: &[Data], node: &str) -> Result<Self, GltfError> {
        let mut sets: BTreeMap<usize, PositionSet> = BTreeMap::new();
        let mut order = Vec::new();
        for (i, primitive) in primitives.iter().enumerate() {
            let set = sets.entry(primitive.position).or_insert_with(|| {
                order.push(primitive.position);
                PositionSet {
                    primitive: i,
                    base: 0,
                    used: Vec::new(),
                    places: vec![u32::MAX; primitive.positions.len()],
                }
            });
            for &v in primitive.triangles.iter().flatten() {
                if let Some(place) = set.places.get_mut(v as usize) {
                    *place = 0;
                }
            }
        }
        let mut end = 0;
        for accessor in order {
            let Some(PositionSet { base, used, places, .. }) = sets.get_mut(&accessor) else { continue };
            let all = places.len();
            *used = (0..).zip(places.iter()).filter(|(_, place)| **place == 0).map(|(v, _)| v).collect();
            let taken = if used.len() * 2 >= all { all } else { used.len() };
            if taken == all {
                (*used, *places) = (Vec::new(), Vec::new());
            }
            for (place, &v) in (0..).zip(used.iter()) {
                if let Some(own) = places.get_mut(v as usize) {
                    *own = place;
                }
            }
            *base = u32::try_from(end).map_err(|_| {
                let what = format!("node {node}");
                GltfError::TooMany { what, found: end as u64, limit: u32::MAX.into() }
            })?;
            end += taken;
        }
        Ok(Self(sets))
    }

    /// Positions of all sets, in the order of the primitives that have them first.
    fn positions<'b>(&'b self, primitives: &'b [Data]) -> impl Iterator<Item = [f32; 3]> + 'b {
        let mut sets: Vec<&PositionSet> = self.0.values().collect();
        sets.sort_by_key(|set| set.primitive);
        sets.into_iter().flat_map(move |set| {
            let all: &[[f32; 3]] = primitives.get(set.primitive).map_or(&[], |primitive| &primitive.positions);
            let whole = if set.places.is_empty() { all } else { &[] };
            whole.iter().copied().chain(set.used.iter().filter_map(|&v| all.get(v as usize).copied()))
        })
    }

    /// Place of vertex `v` of the set of an accessor.
    fn vertex(&self, accessor: usize, v: u32) -> u32 {
        let Some(set) = self.0.get(&accessor) else { return 0 };
        set.base.saturating_add(set.places.get(v as usize).copied().unwrap_or(v))
    }
}

/// Triangles of a list (mode 4), strip (5) or fan (6), as glTF 2.0 section 3.7.2.1 defines them.
fn triangles(list: &[u32], mode: u32) -> Vec<[u32; 3]> {
    match mode {
        5 => list
            .array_windows()
            .enumerate()
            .map(|(i, &[a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
            .collect(),
        6 => match list.split_first() {
            Some((&first, rest)) => rest.array_windows().map(|&[a, b]| [a, b, first]).collect(),
            None => Vec::new(),
        },
        _ => list.as_chunks().0.to_vec(),
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
