//! Picks the backs and the metal of some slots out of those of all, with the prop's own attributes, as alpha masks need
//! them.

use super::{CornerAttributes, FilmAppearance, MeshPart};
use crate::film::HalfEdgeId;

impl FilmAppearance {
    /// Returns the backs of the flakes of those slots that `wanted` asks for, with the prop's own texture coordinates
    /// and vertex colours.
    pub fn backs_in(&self, wanted: impl Fn(usize) -> bool) -> MeshPart {
        self.pick(&self.backs.part, |v| self.backs.corner(v, &self.wedges), wanted)
    }

    /// Returns the bare metal of those slots that `wanted` asks for, with the prop's own texture coordinates and vertex
    /// colours.
    pub fn metal_in(&self, wanted: impl Fn(usize) -> bool) -> MeshPart {
        self.pick(&self.metal.part, |v| self.metal.corner(v), wanted)
    }

    /// Picks the triangles of some slots. Vertices of different slots are different.
    fn pick(
        &self,
        part: &MeshPart,
        corner: impl Fn(usize) -> Option<HalfEdgeId>,
        wanted: impl Fn(usize) -> bool,
    ) -> MeshPart {
        let mut picked = MeshPart::default();
        let mut places = vec![u32::MAX; part.positions.len()];
        for triangle in part.indices.as_chunks::<3>().0 {
            let slot = corner(triangle[0] as usize).map_or(0, |h| self.face_slots.slot(h.face()));
            if !wanted(slot) {
                continue;
            }
            for &v in triangle {
                let v = v as usize;
                if places[v] == u32::MAX {
                    places[v] = picked.positions.len() as u32;
                    picked.positions.push(part.positions[v]);
                    picked.normals.push(part.normals[v]);
                    picked.stains.extend(part.stains.get(v));
                    picked.rest.extend(part.rest.get(v));
                    picked.rest_normals.extend(part.rest_normals.get(v));
                    if let Some(h) = corner(v) {
                        let CornerAttributes { uvs, uvs_1, colors, .. } = &self.attributes;
                        picked.uvs.extend(uvs.get(h.index()).map(|uv| uv.to_array()));
                        picked.uvs_1.extend(uvs_1.get(h.index()).map(|uv| uv.to_array()));
                        picked.colors.extend(colors.get(h.index()).map(|color| color.to_array()));
                    }
                }
                picked.indices.push(places[v]);
            }
        }
        picked
    }
}
