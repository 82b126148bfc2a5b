//! Reads Wavefront OBJ: vertices, faces of any size, and normals, texture coordinates and vertex colours where they are
//! given. The whole file is one surface; materials are not read.
//!
//! Crates for this take whatever index a file holds on trust, or mix up corners that lack a normal or texture
//! coordinate, so the few statements that matter are read here.

use std::{fs, path::Path, str::FromStr};

use bevy_math::{DVec3, Vec2, Vec3, Vec4, ops};

use super::{
    error::BakeError,
    model::{Model, ModelMesh, Slot, centred},
    obj_error::ObjError,
};
use crate::surface::Surface;

/// Faces that meet at more than this angle, in radians, have a crease between them where the file gives no
/// normals.
const CREASE: f32 = 0.7;

/// Reads a file; its mesh has the file's name.
///
/// # Errors
/// [`BakeError::Read`] or [`BakeError::Obj`].
pub fn read_file(path: &Path) -> Result<Model, BakeError> {
    let bytes = fs::read(path).map_err(|source| BakeError::Read { path: path.into(), source })?;
    let name = path.file_stem().map_or("model".into(), |stem| stem.to_string_lossy());
    read(&bytes, &name).map_err(|source| BakeError::Obj { path: path.into(), source })
}

/// Reads the bytes of a file; `name` is its mesh's.
pub fn read(bytes: &[u8], name: &str) -> Result<Model, ObjError> {
    let mut reader = Reader::default();
    reader.read(bytes)?;
    Ok(reader.finish(name.into()))
}

/// One corner of a face: position, texture coordinate and normal.
type Corner = (u32, Option<u32>, Option<u32>);

#[derive(Default)]
struct Reader {
    positions: Vec<Vec3>,
    /// One a position, once any position has a colour.
    colors: Vec<Vec4>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    triangles: Vec<[Corner; 3]>,
}

impl Reader {
    fn read(&mut self, bytes: &[u8]) -> Result<(), ObjError> {
        if bytes.contains(&0) {
            return Err(ObjError::NotText);
        }
        // Names may be in any encoding; what matters is ASCII.
        let text = String::from_utf8_lossy(bytes);
        // A backslash at the end of a line continues it.
        let (mut statement, mut first) = (String::new(), 1);
        for (i, line) in text.lines().enumerate() {
            if statement.is_empty() {
                first = i + 1;
            }
            statement.push_str(line);
            if statement.ends_with('\\') {
                statement.pop();
                statement.push(' ');
                continue;
            }
            self.statement(&statement).map_err(|cause| ObjError::Line { line: first, cause })?;
            statement.clear();
        }
        self.statement(&statement).map_err(|cause| ObjError::Line { line: first, cause })
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
            // Groups, materials, smoothing, points, lines, curves: not needed.
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(format!("a face has {} corners, not three or more", corners.len()));
        }
        // A fan: right for convex faces, and what most programs write.
        self.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
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

    fn finish(mut self, name: String) -> Model {
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
        let material = Some(model.materials.add_plain_paint());
        let (uvs, colors) = (!surface.uvs.is_empty(), !surface.colors.is_empty());
        let slots = vec![Slot { material, uvs, colors, ..Slot::default() }];
        if !surface.triangles.is_empty() {
            model.meshes.push(ModelMesh { name, surface, origin, slots, ..ModelMesh::default() });
        }
        model
    }
}

fn float(word: &str) -> Result<f32, String> {
    f32::from_str(word).map_err(|_| format!("`{word}` is no number"))
}

fn floats<'a>(words: &mut impl Iterator<Item = &'a str>) -> Result<[f32; 3], String> {
    let mut next = || float(words.next().ok_or("a number is missing")?);
    Ok([next()?, next()?, next()?])
}

/// From sRGB to linear.
fn linear(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ops::powf((c + 0.055) / 1.055, 2.4) }
}

/// Smooth normals with creases, three a triangle. Positions need not be finite, nor shared between faces
/// that touch: creases are where vertices are split.
fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let cross = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        (b - a).cross(c - a)
    };
    // Crosses are twice the area long: large faces count for more.
    let crosses: Vec<Vec3> = triangles.iter().map(cross).collect();
    let units: Vec<Vec3> = crosses.iter().map(|n| n.normalize_or(Vec3::Y)).collect();
    let mut around = vec![Vec::new(); positions.len()];
    for (f, triangle) in triangles.iter().enumerate() {
        for &v in triangle {
            around[v as usize].push(f);
        }
    }
    let smooth = ops::cos(CREASE);
    let normal = |f: usize, v: u32| {
        let near = around[v as usize].iter().filter(|&&g| units[f].dot(units[g]) > smooth);
        near.map(|&g| crosses[g]).sum::<Vec3>().normalize_or(units[f])
    };
    triangles.iter().enumerate().flat_map(|(f, t)| t.map(|v| normal(f, v))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Model, ObjError> {
        super::read(text.as_bytes(), "test")
    }

    #[test]
    fn polygons_negative_indices_and_continued_lines() {
        let model = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 \\\n -2 -1 # quad\n").unwrap();
        let surface = &model.meshes[0].surface;
        assert_eq!(surface.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert!(surface.normals.iter().all(|&n| n == Vec3::Z));
    }

    #[test]
    fn corners_may_lack_texture_coordinates_or_normals() {
        let model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nvn 0 0 -1\nf 1/1 2//1 3\n").unwrap();
        let surface = &model.meshes[0].surface;
        assert_eq!(surface.uvs, [Vec2::new(0.25, 0.25), Vec2::ZERO, Vec2::ZERO]);
        assert_eq!(surface.normals, [Vec3::Z, Vec3::NEG_Z, Vec3::Z]);
    }

    #[test]
    fn bad_indices_name_their_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
        for face in ["f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1/2 2 3", "f 1/-9223372036854775808 2 3", "f 1 2", "f 1 2 x"]
        {
            let error = read(&format!("{vertices}{face}\n")).unwrap_err().to_string();
            assert!(error.starts_with("line 5: "), "{face}: {error}");
        }
    }

    #[test]
    fn a_right_angle_is_a_crease() {
        let model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 2 1 4\n").unwrap();
        assert_eq!(model.meshes[0].surface.normals[..3], [Vec3::Z; 3]);
    }
}
