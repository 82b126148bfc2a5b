//! What is seen of an aged film: paint, the backs of flakes, and the metal beneath.
//!
//! - **Paint** is the film wearing the prop's surface: every corner has the prop's UV, colour, normal and tangent at
//!   its place there. Normals and tangents turn with the faces, smoothly where the prop is smooth and along what is
//!   still bound, so that creases stay creases and cracks become ones.
//! - **Backs** are separated faces seen from behind, in primer. Paint that still holds keeps the prop's own back.
//! - **Metal** is the surface at rest where the film has separated or is gone, a little under it.

mod corners;
mod turn;

use std::collections::HashMap;

use bevy_coating::{
    film::{FaceId, VertexId},
    sim::FilmState,
};
use bevy_math::{Vec2, Vec3, Vec4};

use super::{Slot, props::Prop};
use corners::Corners;

/// How far the metal lies under the film, in mean edges: too little to see, enough to tell apart in depth.
const METAL_DEPTH: f32 = 0.01;

/// What a part is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matter {
    /// The prop's own material, of this slot. Separated paint is shown from the front only: it has a back.
    Paint { slot: usize, separated: bool },
    /// Primer, the back of separated paint.
    Primer,
    /// Bare metal.
    Metal,
}

/// A mesh of one matter. Attributes that it does not have are empty.
#[derive(Clone, Debug)]
pub struct Part {
    pub matter: Matter,
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub tangents: Vec<[f32; 4]>,
    pub uvs: Vec<[f32; 2]>,
    pub uvs_1: Vec<[f32; 2]>,
    pub colors: Vec<[f32; 4]>,
    pub indices: Vec<u32>,
}

/// The parts of a film, none of them empty.
pub fn parts(prop: &Prop, film: &FilmState) -> Vec<Part> {
    let corners = Corners::new(prop, film);
    let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
    let separated = |f: FaceId| topology.corners(f).iter().any(|&v| !film.forces.is_attached(v));
    let slot_of = |f: FaceId| prop.built.slots.get(f.index()).map_or(0, |&slot| slot as usize);

    let mut parts = Vec::new();
    for (slot, &has) in prop.slots.iter().enumerate() {
        for lifted in [false, true] {
            let mut builder = Builder::new(Matter::Paint { slot, separated: lifted }, has);
            for f in topology.live_faces().filter(|&f| slot_of(f) == slot && separated(f) == lifted) {
                let face = [0, 1, 2].map(|i| {
                    let v = topology.corners(f)[i];
                    (v, geometry.positions[v.index()], corners.at(f, i))
                });
                builder.face(face);
            }
            parts.extend(builder.finish());
        }
    }

    let mut backs = Builder::new(Matter::Primer, Slot::default());
    for f in topology.live_faces().filter(|&f| separated(f)) {
        backs.face([0, 2, 1].map(|i| {
            let v = topology.corners(f)[i];
            let corner = corners.at(f, i);
            (v, geometry.positions[v.index()], Corner { normal: -corner.normal, ..corner })
        }));
    }
    parts.extend(backs.finish());

    let mut metal = Builder::new(Matter::Metal, Slot::default());
    for f in topology.all_faces().filter(|&f| !topology.is_live(f) || separated(f)) {
        metal.face([0, 1, 2].map(|i| {
            let v = topology.original(topology.corners(f)[i]);
            let under = geometry.rest_normals[v.index()] * (METAL_DEPTH * geometry.mean_edge);
            (v, geometry.rest_positions[v.index()] - under, corners.at_rest(f, i))
        }));
    }
    parts.extend(metal.finish());
    parts
}

/// All that a corner wears.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    pub normal: Vec3,
    pub tangent: Vec4,
    pub uv: Vec2,
    pub uv_1: Vec2,
    pub color: Vec4,
}

/// Corners that are equal to this share a vertex. Interpolation over different triangles differs in the last
/// bits, so values are compared in steps too small to see.
type Key = (u32, [i32; 15]);

/// Collects faces into a part.
struct Builder {
    has: Slot,
    part: Part,
    known: HashMap<Key, u32>,
}

impl Builder {
    fn new(matter: Matter, has: Slot) -> Self {
        let part = Part {
            matter,
            positions: Vec::new(),
            normals: Vec::new(),
            tangents: Vec::new(),
            uvs: Vec::new(),
            uvs_1: Vec::new(),
            colors: Vec::new(),
            indices: Vec::new(),
        };
        Self { has, part, known: HashMap::new() }
    }

    fn face(&mut self, corners: [(VertexId, Vec3, Corner); 3]) {
        for (vertex, position, corner) in corners {
            let key = self.key(vertex, &corner);
            let (has, part) = (self.has, &mut self.part);
            let index = *self.known.entry(key).or_insert_with(|| {
                part.positions.push(position.into());
                part.normals.push(corner.normal.into());
                if has.tangents {
                    part.tangents.push(corner.tangent.into());
                }
                if has.uvs {
                    part.uvs.push(corner.uv.into());
                }
                if has.uvs_1 {
                    part.uvs_1.push(corner.uv_1.into());
                }
                if has.colors {
                    part.colors.push(corner.color.into());
                }
                (part.positions.len() - 1) as u32
            });
            part.indices.push(index);
        }
    }

    fn key(&self, vertex: VertexId, corner: &Corner) -> Key {
        let mut key = [0; 15];
        let mut places = key.iter_mut();
        let mut put = |wanted: bool, values: &[f32], steps: f32| {
            for (place, value) in places.by_ref().zip(values) {
                // Casts saturate, and NaN becomes 0.
                *place = if wanted { (value * steps).round() as i32 } else { 0 };
            }
        };
        put(true, &corner.normal.to_array(), 4096.0);
        put(self.has.tangents, &corner.tangent.to_array(), 1024.0);
        put(self.has.uvs, &corner.uv.to_array(), 262_144.0);
        put(self.has.uvs_1, &corner.uv_1.to_array(), 262_144.0);
        put(self.has.colors, &corner.color.to_array(), 1024.0);
        (vertex.0, key)
    }

    fn finish(self) -> Option<Part> {
        (!self.part.indices.is_empty()).then_some(self.part)
    }
}
