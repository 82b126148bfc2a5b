//! Reads the statements of an .obj file and makes a model of them.

use std::{collections::BTreeMap, path::Path};

use bevy_math::{DVec3, Vec2, Vec3, Vec4};

use super::{
    error::ObjError,
    materials::{MaterialName, Materials, linear},
    normals::smooth_normals,
    polygon::triangulate,
    words::{self, Lines, float, floats},
};
use crate::{
    bake::{
        images::Images,
        model::{Model, ModelMesh, Slot, centred},
    },
    surface::Surface,
};

/// Most corners of a face.
const MAX_CORNERS: usize = 1 << 24;

/// One corner of a face: position, texture coordinate and normal.
type Corner = (u32, Option<u32>, Option<u32>);

/// Everything that was read so far.
#[derive(Default)]
pub struct Reader {
    positions: Vec<Vec3>,
    /// One a position, once any position has a colour.
    colors: Vec<Vec4>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    triangles: Vec<[Corner; 3]>,
    /// Slot of each triangle: index into `materials`.
    slots: Vec<u32>,
    /// Materials of faces, in the order of their first faces.
    materials: Vec<MaterialName>,
    slot_of: BTreeMap<MaterialName, u32>,
    /// Material of the faces that follow.
    current: MaterialName,
    /// Names behind `mtllib`.
    libraries: Vec<String>,
}

impl Reader {
    /// Reads the bytes of a file.
    pub fn read(&mut self, bytes: &[u8]) -> Result<(), ObjError> {
        let text = words::text(bytes).ok_or(ObjError::NotText)?;
        for (line, statement) in Lines::new(&text) {
            self.statement(&statement).map_err(|cause| ObjError::Line { line, cause })?;
        }
        Ok(())
    }

    fn statement(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split('#').next().unwrap_or("").split_whitespace();
        match words.next() {
            Some("v") => {
                let [x, y, z] = floats(&mut words)?;
                self.positions.push(Vec3::new(x, y, z));
                let rest: Vec<&str> = words.collect();
                if let &[r, g, b] = rest.as_slice() {
                    // Stored in sRGB by the programs that write it, as by everyone's habit.
                    let [r, g, b] = floats(&mut [r, g, b].into_iter())?.map(linear);
                    self.colors.resize(self.positions.len() - 1, Vec4::ONE);
                    self.colors.push(Vec4::new(r, g, b, 1.0));
                }
            }
            Some("vt") => {
                // v is optional, and counts upward from the lower edge; in glTF it counts downward.
                let u = float(words.next().ok_or("a texture coordinate is missing")?)?;
                let v = words.next().map_or(Ok(0.0), float)?;
                self.uvs.push(Vec2::new(u, 1.0 - v));
            }
            Some("vn") => self.normals.push(floats(&mut words)?.into()),
            Some("f") => self.face(words)?,
            Some("usemtl") => self.current = name_in(line),
            Some("mtllib") => self.libraries.extend(name_in(line).filter(|name| !self.libraries.contains(name))),
            // Groups, smoothing, points, lines, curves: not needed.
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(format!("a face has {} corners, not three or more", corners.len()));
        }
        if corners.len() > MAX_CORNERS {
            return Err(format!("a face has {} corners, more than {MAX_CORNERS}", corners.len()));
        }
        let places: Vec<DVec3> =
            corners.iter().filter_map(|corner| self.positions.get(corner.0 as usize)).map(|p| p.as_dvec3()).collect();
        let slot = match self.slot_of.get(&self.current) {
            Some(&slot) => slot,
            None => {
                let slot = u32::try_from(self.materials.len()).map_err(|_| "there are too many materials")?;
                self.materials.push(self.current.clone());
                self.slot_of.insert(self.current.clone(), slot);
                slot
            }
        };
        let corner = |i: usize| corners.get(i).copied().unwrap_or_default();
        self.triangles.extend(triangulate(&places).into_iter().map(|triangle| triangle.map(corner)));
        self.slots.resize(self.triangles.len(), slot);
        Ok(())
    }

    fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let mut index = |count: usize, what: &str| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => {
                let bad = || format!("{what} {text} does not exist; there are {count} so far");
                let i: i64 = text.parse().map_err(|_| bad())?;
                // Counted from 1, or backward from the last.
                let i = if i < 0 { i.saturating_add(count as i64) } else { i - 1 };
                u32::try_from(i).ok().filter(|&i| (i as usize) < count).map(Some).ok_or_else(bad)
            }
        };
        let position = index(self.positions.len(), "vertex")?.ok_or_else(|| format!("`{word}` is no corner"))?;
        Ok((position, index(self.uvs.len(), "texture coordinate")?, index(self.normals.len(), "normal")?))
    }

    /// Makes a model of one mesh. Files that it refers to are looked up in `folder`.
    pub fn finish(mut self, name: String, folder: Option<&Path>, images: Images) -> Model {
        let mut model = Model::default();
        let mut surface = Surface {
            triangles: self.triangles.iter().map(|corners| corners.map(|(v, _, _)| v)).collect(),
            ..Surface::default()
        };
        let corners = || self.triangles.iter().flatten();
        if corners().any(|corner| corner.1.is_some()) {
            let uv = |i: u32| self.uvs.get(i as usize).copied().filter(|uv| uv.is_finite());
            surface.uvs = corners().map(|corner| corner.1.and_then(uv).unwrap_or_default()).collect();
        }
        let own = |i: u32| self.normals.get(i as usize).and_then(|n| n.try_normalize());
        let made = smooth_normals(&self.positions, &surface.triangles);
        surface.normals = corners().zip(made).map(|(corner, made)| corner.2.and_then(own).unwrap_or(made)).collect();
        if !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), Vec4::ONE);
            surface.colors =
                corners().map(|corner| self.colors.get(corner.0 as usize).copied().unwrap_or(Vec4::ONE)).collect();
        }
        let positions: Vec<DVec3> = self.positions.iter().map(|p| p.as_dvec3()).collect();
        let (positions, origin) = centred(&positions);
        surface.positions = positions;
        let slots = self.slots(!surface.colors.is_empty(), folder, images, &mut model);
        if slots.len() > 1 {
            surface.slots = self.slots;
        }
        if !surface.triangles.is_empty() {
            model.meshes.push(ModelMesh { name, surface, origin, slots, ..ModelMesh::default() });
        }
        model
    }

    /// Attributes and material of each slot; puts the materials into `model`.
    fn slots(&self, colors: bool, folder: Option<&Path>, images: Images, model: &mut Model) -> Vec<Slot> {
        let mut uvs = vec![false; self.materials.len()];
        for (&slot, triangle) in self.slots.iter().zip(&self.triangles) {
            if let Some(uvs) = uvs.get_mut(slot as usize) {
                *uvs |= triangle.iter().any(|corner| corner.1.is_some());
            }
        }
        let mut materials = Materials::new(folder, images);
        self.libraries.iter().for_each(|names| materials.define(names));
        let slot = |(name, uvs)| Slot { material: Some(materials.add(name, uvs)), uvs, colors, ..Slot::default() };
        let slots = self.materials.iter().zip(uvs).map(slot).collect();
        materials.finish(model);
        slots
    }
}

/// The name behind a keyword, which may hold spaces.
fn name_in(line: &str) -> MaterialName {
    let (_, name) = line.trim().split_once(char::is_whitespace)?;
    Some(name.trim().into())
}
