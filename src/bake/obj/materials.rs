//! Turns the materials of .mtl files into glTF's.

use std::{collections::BTreeMap, path::Path, path::PathBuf};

use bevy_math::ops;
use serde_json::{Value, json};

use super::{
    mtl::{self, MtlMap, MtlMaterial},
    words,
};
use crate::{
    bake::{
        images::Images,
        media::media_type,
        model::{Image, MaterialLibrary, Model},
        textures::{MAX_TEXELS, Texture},
        warning::BakeWarning,
    },
    files,
};

/// Greatest exponent of a highlight (`Ns`).
const MOST_SHININESS: f32 = 1000.0;
/// The edge of an image goes on beyond it (glTF `CLAMP_TO_EDGE`).
const CLAMP_TO_EDGE: u32 = 33071;

/// A name that faces are made of, as `usemtl` has it; `None` for faces before the first.
pub type MaterialName = Option<String>;

/// Makes the materials of a model.
pub struct Materials<'a> {
    folder: Option<&'a Path>,
    images: Images,
    /// All that files define, each with its file's folder, by name.
    defined: BTreeMap<String, (MtlMaterial, PathBuf)>,
    library: MaterialLibrary,
    /// Index of each image by its path; `None` for those that cannot be read.
    loaded: BTreeMap<PathBuf, Option<usize>>,
    /// Number of the images that cannot be read, and the first of them.
    unreadable: (usize, Option<(String, String)>),
    /// Names of statements whose images were left out.
    left_out: Vec<String>,
    undefined: Vec<String>,
    files_missing: bool,
    files: Vec<PathBuf>,
    warnings: Vec<BakeWarning>,
}

impl<'a> Materials<'a> {
    /// Without any material. Files are looked up in `folder`.
    pub fn new(folder: Option<&'a Path>, images: Images) -> Self {
        Self {
            folder,
            images,
            defined: BTreeMap::new(),
            library: MaterialLibrary::default(),
            loaded: BTreeMap::new(),
            unreadable: (0, None),
            left_out: Vec::new(),
            undefined: Vec::new(),
            files_missing: false,
            files: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Reads the files that a statement `mtllib` names: one whose name may hold spaces, or several.
    pub fn define(&mut self, names: &str) {
        let is_one = |folder: &Path| locate(folder, names).is_some_and(|path| path.exists());
        if self.folder.is_none_or(is_one) {
            return self.define_file(names);
        }
        names.split_whitespace().for_each(|name| self.define_file(name));
    }

    fn define_file(&mut self, name: &str) {
        let read = || {
            let folder = self.folder.ok_or("it is a file of its own, and the model is none")?;
            let path = locate(folder, name).ok_or("its name cannot be used")?;
            let bytes = files::read(&path).map_err(|error| error.to_string())?;
            Ok::<_, String>((path, bytes))
        };
        let result = read().and_then(|(path, bytes)| {
            let text = words::text(&bytes).ok_or("it is no text")?;
            Ok((path, mtl::read(&text)))
        });
        let (path, file) = match result {
            Ok(found) => found,
            Err(cause) => {
                self.files_missing = true;
                return self.warnings.push(BakeWarning::MaterialFile { file: name.into(), cause });
            }
        };
        if let Some((line, cause)) = file.faults.first().cloned() {
            let count = file.faults.len();
            self.warnings.push(BakeWarning::MaterialStatements { file: name.into(), count, line, cause });
        }
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        for material in file.materials {
            self.defined.entry(material.name.clone()).or_insert_with(|| (material, folder.clone()));
        }
        self.files.push(path);
    }

    /// Adds the material that faces have, and returns its index. `uvs` says whether they have texture coordinates.
    pub fn add(&mut self, name: &MaterialName, uvs: bool) -> usize {
        let index = self.library.add_plain_paint();
        let Some(name) = name else { return index };
        let material = match self.defined.get(name).cloned() {
            Some((material, folder)) => self.convert(&material, &folder, uvs),
            None => {
                self.undefined.push(name.clone());
                let mut paint = self.library.materials.get_mut(index).map(Value::take).unwrap_or_default();
                insert(&mut paint, "name", Some(name.as_str().into()));
                paint
            }
        };
        if let Some(plain) = self.library.materials.get_mut(index) {
            *plain = material;
        }
        index
    }

    /// Puts materials, files and warnings into a model.
    pub fn finish(mut self, model: &mut Model) {
        if let (Some(first), false) = (self.undefined.first().cloned(), self.files_missing) {
            self.warnings.push(BakeWarning::MaterialsUndefined { count: self.undefined.len(), first });
        }
        if let (count, Some((first, cause))) = self.unreadable {
            self.warnings.push(BakeWarning::ImagesUnreadable { count, first, cause });
        }
        if !self.left_out.is_empty() {
            let count = self.left_out.len();
            self.left_out.sort_unstable();
            self.left_out.dedup();
            self.warnings.push(BakeWarning::MapsLeftOut { count, kinds: self.left_out.join(", ") });
        }
        model.materials = self.library;
        model.warnings.extend(self.warnings);
        model.files.extend(self.files);
    }

    fn convert(&mut self, material: &MtlMaterial, folder: &Path, uvs: bool) -> Value {
        self.left_out.extend(material.other_maps.iter().cloned());
        // An image takes the place of the colour, as in the programs that write both.
        let base_map = self.map("map_Kd", &material.diffuse_map, folder, uvs);
        let own = |color: Option<[f32; 3]>| color.map(|color| color.map(|c| linear(unit(c))));
        let [r, g, b] = if base_map.is_some() { [1.0; 3] } else { own(material.diffuse).unwrap_or([1.0; 3]) };
        // Paint that nobody sees is a mistake of the exporter.
        let opacity = material.opacity.map(unit).filter(|&opacity| opacity > 0.0).unwrap_or(1.0);
        let mut pbr = json!({
            "baseColorFactor": [r, g, b, opacity],
            "metallicFactor": material.metallic.map_or(0.0, unit),
            "roughnessFactor": roughness(material),
        });
        let masked = base_map.is_some() && self.is_mask(material);
        insert(&mut pbr, "baseColorTexture", base_map);
        let mut fields = json!({ "name": material.name, "doubleSided": true, "pbrMetallicRoughness": pbr });
        if masked || opacity < 1.0 {
            insert(&mut fields, "alphaMode", Some(if masked { "MASK" } else { "BLEND" }.into()));
        }
        let mut normals = self.map("norm", &material.normal_map, folder, uvs);
        if let (None, Some(bump)) = (&normals, &material.bump_map) {
            if self.images == Images::Load && holds_heights(folder, &bump.file) {
                self.left_out.push("map_Bump (heights)".into());
            } else {
                normals = self.map("map_Bump", &material.bump_map, folder, uvs);
            }
        }
        let strength = material.normal_map.as_ref().or(material.bump_map.as_ref()).map_or(1.0, |map| map.strength);
        if let (Some(map), true) = (&mut normals, strength.is_finite() && strength != 1.0) {
            insert(map, "scale", Some(strength.into()));
        }
        insert(&mut fields, "normalTexture", normals);
        let emission_map = self.map("map_Ke", &material.emission_map, folder, uvs);
        let emission = own(material.emission).filter(|color| *color != [0.0; 3]);
        if let Some(color) = emission.or(emission_map.as_ref().map(|_| [1.0; 3])) {
            insert(&mut fields, "emissiveFactor", Some(json!(color)));
        }
        insert(&mut fields, "emissiveTexture", emission_map);
        fields
    }

    /// Whether the alpha of the colour's image is a mask; an image of its own is left out.
    fn is_mask(&mut self, material: &MtlMaterial) -> bool {
        let (Some(opacity), Some(color)) = (&material.opacity_map, &material.diffuse_map) else { return false };
        if opacity.file != color.file {
            self.left_out.push("map_d".into());
        }
        opacity.file == color.file
    }

    /// A reference to an image, which is read once.
    fn map(&mut self, statement: &str, map: &Option<MtlMap>, folder: &Path, uvs: bool) -> Option<Value> {
        let map = map.as_ref()?;
        if !uvs {
            self.left_out.push(format!("{statement} (no texture coordinates)"));
            return None;
        }
        let image = self.image(map, folder)?;
        Some(self.texture(map, image))
    }

    fn texture(&mut self, map: &MtlMap, image: usize) -> Value {
        let mut texture = json!({ "source": image });
        if map.clamp {
            let sampler = json!({ "wrapS": CLAMP_TO_EDGE, "wrapT": CLAMP_TO_EDGE });
            let sampler = position_of(&mut self.library.samplers, sampler);
            insert(&mut texture, "sampler", Some(sampler.into()));
        }
        let mut info = json!({ "index": position_of(&mut self.library.textures, texture) });
        let ([u, v], [su, sv]) = (map.offset, map.scale);
        if (map.offset, map.scale) != ([0.0; 2], [1.0; 2]) && [u, v, su, sv].iter().all(|x| x.is_finite()) {
            const NAME: &str = "KHR_texture_transform";
            // v counts upward there, downward here.
            let transform = json!({ NAME: { "offset": [u, 1.0 - v - sv], "scale": [su, sv] } });
            insert(&mut info, "extensions", Some(transform));
            if self.library.extensions_used.is_empty() {
                self.library.extensions_used.push(NAME.into());
            }
        }
        info
    }

    fn image(&mut self, map: &MtlMap, folder: &Path) -> Option<usize> {
        let path = locate(folder, &map.file)?;
        if let Some(&known) = self.loaded.get(&path) {
            return known;
        }
        let index = match self.images {
            Images::Skip => None,
            Images::Load => match read_image(&path) {
                Ok(image) => {
                    self.library.images.push(image);
                    Some(self.library.images.len() - 1)
                }
                Err(cause) => {
                    self.unreadable.0 += 1;
                    self.unreadable.1.get_or_insert((map.file.clone(), cause));
                    None
                }
            },
        };
        self.files.push(path.clone());
        self.loaded.insert(path, index);
        index
    }
}

/// The place of a file that is named in a model in `folder`. What was written on another system, or names a folder of
/// its author's, is looked up beside the model by its name alone.
fn locate(folder: &Path, name: &str) -> Option<PathBuf> {
    let name = name.replace('\\', "/");
    if let Some(path) = files::relative(&name).map(|path| folder.join(path)).filter(|path| path.exists()) {
        return Some(path);
    }
    let last = name.rsplit('/').next().filter(|last| !last.is_empty() && !matches!(*last, "." | ".."))?;
    files::relative(last).map(|last| folder.join(last))
}

fn read_image(path: &Path) -> Result<Image, String> {
    let bytes = files::read(path).map_err(|error| error.to_string())?;
    let mime_type = media_type(&bytes).filter(|media| matches!(*media, "image/png" | "image/jpeg"));
    let mime_type = mime_type.ok_or("it is neither PNG nor JPEG; convert it")?.to_owned();
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    Ok(Image { name, mime_type, bytes: bytes.into(), ..Image::default() })
}

/// Whether an image holds heights rather than normals, as both are found behind `map_Bump`. Heights are grey; normals
/// point outward on the whole.
fn holds_heights(folder: &Path, file: &str) -> bool {
    let mean = || Some(Texture::decode(&read_image(&locate(folder, file)?).ok()?, false, MAX_TEXELS).ok()?.mean());
    mean().is_some_and(|mean| mean.z < 0.7 || (mean.x - 0.5).abs() > 0.2 || (mean.y - 0.5).abs() > 0.2)
}

/// Roughness, as it is written or by the highlight (`Ns`), as Blender writes it: 1 - sqrt(Ns / 1000).
fn roughness(material: &MtlMaterial) -> f32 {
    const DEFAULT: f32 = 0.45;
    let by_highlight = |shininess: f32| 1.0 - (shininess.clamp(0.0, MOST_SHININESS) / MOST_SHININESS).sqrt();
    let finite = |x: &f32| x.is_finite();
    let own = material.roughness.filter(finite).map(unit);
    own.or(material.shininess.filter(finite).map(by_highlight)).unwrap_or(DEFAULT)
}

/// 0 to 1; NaN becomes 0.
fn unit(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) }
}

/// From sRGB to linear.
pub fn linear(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ops::powf((c + 0.055) / 1.055, 2.4) }
}

fn insert(object: &mut Value, key: &str, value: Option<Value>) {
    if let (Some(value), Some(fields)) = (value, object.as_object_mut()) {
        fields.insert(key.into(), value);
    }
}

/// The index of a value in a list, to which it is added if it is not there.
fn position_of(list: &mut Vec<Value>, value: Value) -> usize {
    list.iter().position(|known| *known == value).unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(color: [u8; 3]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(&color.repeat(4))).expect("a PNG");
        bytes
    }

    /// A model of one material in a folder with these files.
    fn convert(mtl: &str, images: &[(&str, &[u8])], uvs: bool) -> Model {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join("maps")).expect("a folder");
        std::fs::write(folder.path().join("a.mtl"), mtl).expect("a file");
        images.iter().for_each(|(name, bytes)| std::fs::write(folder.path().join(name), bytes).expect("a file"));
        let mut materials = Materials::new(Some(folder.path()), Images::Load);
        materials.define("a.mtl");
        materials.add(&Some("a".into()), uvs);
        let mut model = Model::default();
        materials.finish(&mut model);
        model
    }

    #[test]
    fn colours_are_srgb_and_highlights_are_roughness() {
        let model = convert("newmtl a\nKd 1 0.5 0\nNs 250\nd 0.25\nKe 0 0 1\n", &[], false);
        let material = &model.materials.materials[0];
        let pbr = &material["pbrMetallicRoughness"];
        let expected = json!([1.0f32, linear(0.5), 0.0f32, 0.25f32]);
        assert_eq!((&pbr["baseColorFactor"], &pbr["roughnessFactor"]), (&expected, &json!(0.5)));
        assert_eq!((&material["alphaMode"], &material["emissiveFactor"]), (&json!("BLEND"), &json!([0.0, 0.0, 1.0])));
        assert!(model.warnings.is_empty(), "{:?}", model.warnings);
    }

    #[test]
    fn images_are_found_by_paths_of_other_systems_too() {
        let red = png([255, 0, 0]);
        let mtl = "newmtl a\nKd 0 0 0\nmap_Kd -s 2 4 maps\\red.png\nnorm C:\\work\\up.png\nmap_Ke maps/red.png\n";
        let model = convert(mtl, &[("maps/red.png", &red), ("up.png", &png([128, 128, 255]))], true);
        assert!(model.warnings.is_empty(), "{:?}", model.warnings);
        let material = &model.materials.materials[0];
        assert_eq!(model.materials.images.len(), 2);
        assert_eq!(*model.materials.images[0].bytes, red);
        let map = &material["pbrMetallicRoughness"]["baseColorTexture"];
        // 1 - v = 1 - 4 (1 - v'), so v = 4 v' + (1 - 4).
        let moved = json!({ "KHR_texture_transform": { "offset": [0.0, -3.0], "scale": [2.0, 4.0] } });
        assert_eq!((&map["index"], &map["extensions"]), (&json!(0), &moved));
        assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"], json!([1.0, 1.0, 1.0, 1.0]));
        assert_eq!(
            (&material["normalTexture"]["index"], &material["emissiveTexture"]["index"]),
            (&json!(1), &json!(0))
        );
        assert_eq!(model.files.len(), 3);
    }

    #[test]
    fn bumps_are_normals_unless_they_are_grey() {
        for (color, kept) in [([128, 128, 255], true), ([128, 128, 128], false), ([255, 255, 255], false)] {
            let model = convert("newmtl a\nmap_Bump -bm 0.5 b.png\n", &[("b.png", &png(color))], true);
            let map = &model.materials.materials[0]["normalTexture"];
            assert_eq!((map["scale"].as_f64(), model.warnings.len()), (kept.then_some(0.5), usize::from(!kept)));
            assert_eq!(model.materials.images.len(), usize::from(kept));
        }
    }

    #[test]
    fn what_is_missing_is_one_warning_a_kind() {
        let mtl =
            "newmtl a\nKd 0 1 0\nmap_Kd gone.png\nmap_Ke gone.png\nnorm a.mtl\nmap_Ks x.png\nmap_Ns x.png\nKd x\nKd\n";
        let model = convert(mtl, &[], true);
        let texts: Vec<String> = model.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(texts.len(), 3, "{texts:?}");
        assert!(texts[0].starts_with("a.mtl: 2 statements") && texts[0].contains("line 8"), "{}", texts[0]);
        assert!(texts[1].starts_with("2 images") && texts[1].contains("gone.png"), "{}", texts[1]);
        assert!(texts[2].contains("map_Ks, map_Ns"), "{}", texts[2]);
        // The colour is seen where its image is missing.
        assert_eq!(
            model.materials.materials[0]["pbrMetallicRoughness"]["baseColorFactor"],
            json!([0.0, 1.0, 0.0, 1.0])
        );
        assert!(model.materials.textures.is_empty());
        assert_eq!(convert("newmtl a\nmap_Kd gone.png\n", &[], false).warnings.len(), 1, "no coordinates");
    }
}
