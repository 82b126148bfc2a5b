//! Reads the statements of .mtl files, the materials beside Wavefront OBJ.

use super::words::{Lines, float, floats};

/// A material as it is written. Statements that glTF has no place for, such as reflections of the surroundings, are
/// not here.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MtlMaterial {
    pub name: String,
    /// Colour (`Kd`).
    pub diffuse: Option<[f32; 3]>,
    /// Light of its own (`Ke`).
    pub emission: Option<[f32; 3]>,
    /// Opacity (`d`, or 1 less `Tr`).
    pub opacity: Option<f32>,
    /// Exponent of the highlight (`Ns`).
    pub shininess: Option<f32>,
    /// Roughness (`Pr`).
    pub roughness: Option<f32>,
    /// Metalness (`Pm`).
    pub metallic: Option<f32>,
    pub diffuse_map: Option<MtlMap>,
    pub emission_map: Option<MtlMap>,
    pub opacity_map: Option<MtlMap>,
    /// Normals (`norm`).
    pub normal_map: Option<MtlMap>,
    /// Heights, or in many files normals (`map_Bump`, `bump`).
    pub bump_map: Option<MtlMap>,
    /// Names of the statements of other images.
    pub other_maps: Vec<String>,
}

/// An image as a material uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct MtlMap {
    /// Path as it is written.
    pub file: String,
    /// Offset (`-o`) and scale (`-s`) of its coordinates, where v counts upward.
    pub offset: [f32; 2],
    pub scale: [f32; 2],
    /// Strength of a relief (`-bm`).
    pub strength: f32,
    /// Whether it ends at its edges instead of repeating (`-clamp on`).
    pub clamp: bool,
}

/// Materials of a file, in order, and the statements that cannot be read.
#[derive(Clone, Debug, Default)]
pub struct MtlFile {
    pub materials: Vec<MtlMaterial>,
    /// Numbers of their lines and faults.
    pub faults: Vec<(usize, String)>,
}

/// Reads the text of a file. Whatever cannot be read is left out.
pub fn read(text: &str) -> MtlFile {
    let mut file = MtlFile::default();
    for (line, statement) in Lines::new(text) {
        if let Err(cause) = read_statement(&mut file.materials, &statement) {
            file.faults.push((line, cause));
        }
    }
    file
}

fn read_statement(materials: &mut Vec<MtlMaterial>, statement: &str) -> Result<(), String> {
    let statement = statement.trim();
    let (keyword, rest) = statement.split_once(char::is_whitespace).unwrap_or((statement, ""));
    let rest = rest.trim();
    if keyword == "newmtl" {
        if rest.is_empty() {
            return Err("a material has no name".into());
        }
        materials.push(MtlMaterial { name: rest.into(), ..MtlMaterial::default() });
        return Ok(());
    }
    // Comments begin a line; names of files may hold the sign.
    let Some(material) = materials.last_mut().filter(|_| !keyword.starts_with('#')) else { return Ok(()) };
    let one = || float(rest.split_whitespace().next().ok_or("a number is missing")?);
    match keyword.to_ascii_lowercase().as_str() {
        "kd" => material.diffuse = Some(color(rest)?),
        "ke" => material.emission = Some(color(rest)?),
        "d" => {
            let halo = rest.strip_prefix("-halo").unwrap_or(rest);
            material.opacity = Some(float(halo.trim())?);
        }
        // Where both are given, `d` counts.
        "tr" => material.opacity = material.opacity.or(Some(1.0 - one()?)),
        "ns" => material.shininess = Some(one()?),
        "pr" => material.roughness = Some(one()?),
        "pm" => material.metallic = Some(one()?),
        "map_kd" => material.diffuse_map = Some(map(rest)?),
        "map_ke" => material.emission_map = Some(map(rest)?),
        "map_d" => material.opacity_map = Some(map(rest)?),
        "norm" | "map_kn" => material.normal_map = Some(map(rest)?),
        "map_bump" | "bump" => material.bump_map = Some(map(rest)?),
        "disp" | "decal" | "refl" => material.other_maps.push(keyword.into()),
        other if other.starts_with("map_") && other != "map_aat" => material.other_maps.push(keyword.into()),
        _ => {}
    }
    Ok(())
}

/// Three numbers, or one for a grey.
fn color(text: &str) -> Result<[f32; 3], String> {
    let mut words = text.split_whitespace();
    if let (Some(grey), None) = (words.next(), words.next()) {
        return Ok([float(grey)?; 3]);
    }
    floats(&mut text.split_whitespace())
}

/// Options, then the path, which may hold spaces.
fn map(text: &str) -> Result<MtlMap, String> {
    let mut map = MtlMap { file: String::new(), offset: [0.0; 2], scale: [1.0; 2], strength: 1.0, clamp: false };
    let mut rest = text;
    while rest.starts_with('-') {
        let (option, mut after) = next_word(rest);
        let mut values = Vec::new();
        let (least, most) = match option {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-cc" | "-clamp" | "-texres" | "-bm" | "-boost" | "-imfchan" | "-type" => (1, 1),
            // A file that begins like an option.
            _ => break,
        };
        while values.len() < most {
            let (word, next) = next_word(after);
            if values.len() >= least && float(word).is_err() {
                break;
            }
            values.push(word);
            after = next;
        }
        let first = values.first().copied().unwrap_or_default();
        let pair = |default: f32| -> Result<[f32; 2], String> {
            Ok([float(first)?, values.get(1).map_or(Ok(default), |v| float(v))?])
        };
        match option {
            "-o" => map.offset = pair(0.0)?,
            "-s" => map.scale = pair(1.0)?,
            "-bm" => map.strength = float(first)?,
            "-clamp" => map.clamp = first == "on",
            _ => {}
        }
        rest = after;
    }
    if rest.is_empty() {
        return Err("the name of an image is missing".into());
    }
    map.file = rest.into();
    Ok(map)
}

/// The first word, and what comes after it.
fn next_word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_keep_their_order_and_what_is_said_of_them() {
        let text = "# made by hand\r\nKd 9 9 9\r\nnewmtl red paint\r\n\tKd 1 0.5 0.25\r\nd 0.5\r\nTr 0.9\r\nNs 10\r\n\
                    newmtl grey\nKd 0.5\nTr 0.25\nPr 0.3\nPm 1\nKe 0 1 0\nmap_Ks a.png\nillum 2\n";
        let file = read(text);
        assert!(file.faults.is_empty(), "{:?}", file.faults);
        let [red, grey] = file.materials.as_slice() else { panic!("{:?}", file.materials) };
        assert_eq!((red.name.as_str(), red.diffuse, red.opacity), ("red paint", Some([1.0, 0.5, 0.25]), Some(0.5)));
        assert_eq!((grey.diffuse, grey.opacity, grey.shininess), (Some([0.5; 3]), Some(0.75), None));
        assert_eq!((grey.roughness, grey.metallic, grey.emission), (Some(0.3), Some(1.0), Some([0.0, 1.0, 0.0])));
        assert_eq!(grey.other_maps, ["map_Ks"]);
    }

    #[test]
    fn images_have_options_and_spaces_in_their_names() {
        let text = "newmtl a\nmap_Kd -s 2 3 -o 0.5 -clamp on my textures/a b.png\nmap_Bump -bm 0.3 -imfchan r b.png\n\
                    norm -mm 0 1 -odd.png";
        let file = read(text);
        assert!(file.faults.is_empty(), "{:?}", file.faults);
        let material = &file.materials[0];
        let color = material.diffuse_map.as_ref().expect("a map");
        assert_eq!((color.file.as_str(), color.scale, color.offset), ("my textures/a b.png", [2.0, 3.0], [0.5, 0.0]));
        assert!(color.clamp);
        let bump = material.bump_map.as_ref().expect("a map");
        assert_eq!((bump.file.as_str(), bump.strength, bump.clamp), ("b.png", 0.3, false));
        assert_eq!(material.normal_map.as_ref().map(|map| map.file.as_str()), Some("-odd.png"));
    }

    #[test]
    fn bad_statements_are_left_out_and_named() {
        let file = read("newmtl a\nKd 1 x 0\nNs\nmap_Kd -s\nmap_Kd\nnewmtl\nKd 1 1 1\n");
        let lines: Vec<usize> = file.faults.iter().map(|&(line, _)| line).collect();
        assert_eq!(lines, [2, 3, 4, 5, 6]);
        assert_eq!((file.materials.len(), file.materials[0].diffuse), (1, Some([1.0; 3])));
    }
}
