//! Reads the values of options.

use std::{convert::Infallible, ffi::OsString, path::PathBuf};

use bevy_coating::{
    bake::{MAX_AGE, MAX_TRIANGLES, NamePattern, TEXTURE_SIZES, UNITS},
    deform::SolverQuality,
    remesh::FilmResolution,
};
use bevy_math::{DVec3, Vec3};

/// Strongest wind, in pulls of gravity.
pub const MAX_WIND: f32 = 100.0;
/// Widest gusts, in metres a metre.
const MAX_GUSTS: f32 = 10.0;

/// A pattern of names.
pub fn parse_pattern(text: &str) -> Result<NamePattern, Infallible> {
    Ok(NamePattern::new(text))
}

/// The name of a .glb file.
pub fn parse_glb(path: OsString) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(path);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("gltf") => Err("what is written is binary glTF: name it .glb"),
        _ => Ok(path),
    }
}

/// The path of a setting and its value.
pub fn parse_set(text: &str) -> Result<(String, String), &'static str> {
    let (path, value) = text.split_once('=').ok_or("write it as path=value")?;
    Ok((path.trim().into(), value.trim().into()))
}

/// The name of a quality.
pub fn parse_quality(text: &str) -> Result<SolverQuality, &'static str> {
    SolverQuality::named(text).ok_or("not reference, high, default or fast")
}

/// An age in its range.
pub fn parse_age(text: &str) -> Result<f64, String> {
    let age = text.parse::<f64>().ok().filter(|age| (0.0..=MAX_AGE).contains(age));
    age.ok_or_else(|| format!("not a number from 0 to {MAX_AGE}"))
}

/// A number of triangles, or `keep`.
pub fn parse_triangles(text: &str) -> Result<FilmResolution, String> {
    if text == "keep" {
        return Ok(FilmResolution::Keep);
    }
    let count = parse_count(text).map(FilmResolution::Triangles);
    count.map_err(|_| format!("neither `keep` nor a number from 4 to {MAX_TRIANGLES}"))
}

/// A number of triangles.
pub fn parse_count(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|n| (4..=MAX_TRIANGLES).contains(n));
    count.ok_or_else(|| format!("not a number from 4 to {MAX_TRIANGLES}"))
}

/// A length of edges.
pub fn parse_edge(text: &str) -> Result<FilmResolution, &'static str> {
    let edge = text.parse().ok().map(FilmResolution::EdgeLength).filter(|edge| edge.validate().is_ok());
    edge.ok_or("not a number of metres above 0")
}

/// A unit's length in its range.
pub fn parse_unit(text: &str) -> Result<f32, String> {
    let metres = text.parse().ok().filter(|metres| UNITS.contains(metres));
    metres.ok_or_else(|| format!("not a number from {} to {}", UNITS.start(), UNITS.end()))
}

/// A size of textures in its range.
pub fn parse_texture_size(text: &str) -> Result<u32, String> {
    let size = text.parse().ok().filter(|size| TEXTURE_SIZES.contains(size));
    size.ok_or_else(|| format!("not a number from {} to {}", TEXTURE_SIZES.start(), TEXTURE_SIZES.end()))
}

/// A direction, one long.
pub fn parse_gravity(text: &str) -> Result<Vec3, &'static str> {
    let direction = parse_numbers(text).ok_or("write it as three finite numbers, like 0,-1,0")?;
    // By the largest part first, so that no square can overflow.
    let largest = direction.abs().max_element();
    (direction / largest).try_normalize().map(|g| g.as_vec3()).ok_or("gravity needs a direction")
}

/// A vector that is at most so long.
pub fn parse_vector(text: &str, longest: f64) -> Result<Vec3, String> {
    let vector = parse_numbers(text).ok_or("write it as three finite numbers, like 0.3,0,-0.2")?;
    // A little more is rounding: 0.6,-0.8,0 is one long.
    if vector.length() <= longest * 1.000_001 {
        Ok(vector.as_vec3())
    } else {
        Err(format!("its length is more than {longest}"))
    }
}

/// A width of gusts in its range.
pub fn parse_gusts(text: &str) -> Result<f32, String> {
    let gusts = text.parse::<f32>().ok().filter(|gusts| (0.0..=MAX_GUSTS).contains(gusts));
    gusts.ok_or_else(|| format!("not a number from 0 to {MAX_GUSTS}"))
}

/// Three finite numbers between commas.
fn parse_numbers(text: &str) -> Option<DVec3> {
    let parts: Vec<f64> = text.split(',').map_while(|part| part.trim().parse().ok()).collect();
    let &[x, y, z] = parts.as_slice() else { return None };
    let whole = text.split(',').count() == 3;
    Some(DVec3::new(x, y, z)).filter(|vector| whole && vector.is_finite())
}
