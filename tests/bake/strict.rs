//! Checks a .glb strictly: what the specification asks of structure, references, buffers, accessors and images.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

/// A file taken apart.
pub struct Glb {
    pub root: Value,
    pub binary: Vec<u8>,
}

/// Kinds of lists, by their names.
const LISTS: [&str; 12] = [
    "accessors",
    "animations",
    "bufferViews",
    "buffers",
    "cameras",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scenes",
    "skins",
];

impl Glb {
    /// Takes a file apart and checks all of it.
    pub fn checked(bytes: &[u8]) -> Self {
        let glb = Self::new(bytes);
        glb.check();
        gltf::Gltf::from_slice_without_validation(bytes).expect("another reader takes it");
        glb
    }

    pub fn new(bytes: &[u8]) -> Self {
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
        assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()), "the header");
        let json = word(12);
        assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0), "the first chunk");
        let at = 20 + json;
        assert_eq!((&bytes[at + 4..at + 8], word(at) % 4, at + 8 + word(at)), (&b"BIN\0"[..], 0, bytes.len()));
        Self { root: serde_json::from_slice(&bytes[20..at]).expect("JSON"), binary: bytes[at + 8..].to_vec() }
    }

    pub fn list(&self, name: &str) -> &[Value] {
        self.root[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// Elements of an accessor as bytes, each with its offset in the binary chunk; empty without a buffer view.
    fn elements(&self, accessor: &Value) -> Vec<&[u8]> {
        let Some(view) = index(&accessor["bufferView"]) else { return Vec::new() };
        let view = &self.list("bufferViews")[view];
        let size = component_size(accessor) * components(accessor);
        let stride = view["byteStride"].as_u64().map_or(size, |stride| stride as usize);
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        (0..number(&accessor["count"])).map(|i| &self.binary[start + i * stride..][..size]).collect()
    }

    /// Floats of an accessor, whatever its components.
    pub fn floats(&self, accessor: usize) -> Vec<Vec<f64>> {
        let accessor = &self.list("accessors")[accessor];
        let size = component_size(accessor);
        let value = |bytes: &[u8]| match accessor["componentType"].as_u64() {
            Some(5120) => f64::from(bytes[0] as i8),
            Some(5121) => f64::from(bytes[0]),
            Some(5122) => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
            Some(5123) => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            Some(5125) => f64::from(u32::from_le_bytes(bytes.try_into().expect("four bytes"))),
            _ => f64::from(f32::from_le_bytes(bytes.try_into().expect("four bytes"))),
        };
        self.elements(accessor).into_iter().map(|element| element.chunks(size).map(value).collect()).collect()
    }

    /// Triangles of a primitive, by vertex.
    pub fn triangles(&self, primitive: &Value) -> Vec<[usize; 3]> {
        let list: Vec<usize> = match index(&primitive["indices"]) {
            Some(indices) => self.floats(indices).into_iter().map(|i| i[0] as usize).collect(),
            None => {
                let positions = index(&primitive["attributes"]["POSITION"]).expect("positions");
                (0..number(&self.list("accessors")[positions]["count"])).collect()
            }
        };
        list.as_chunks::<3>().0.to_vec()
    }

    /// Bytes of an image.
    pub fn image(&self, image: usize) -> &[u8] {
        let view = index(&self.list("images")[image]["bufferView"]).expect("a buffer view");
        let view = &self.list("bufferViews")[view];
        &self.binary[number(&view["byteOffset"])..][..number(&view["byteLength"])]
    }

    fn check(&self) {
        assert_eq!(self.root["asset"]["version"], "2.0");
        for (name, list) in self.root.as_object().expect("an object") {
            assert!(!list.as_array().is_some_and(Vec::is_empty), "{name} is empty");
            if LISTS.contains(&name.as_str()) {
                assert!(self.list(name).iter().all(Value::is_object), "{name} has something that is no object");
            }
        }
        self.check_buffers();
        self.list("accessors").iter().enumerate().for_each(|(i, accessor)| self.check_accessor(i, accessor));
        self.check_nodes();
        for (i, mesh) in self.list("meshes").iter().enumerate() {
            let primitives = mesh["primitives"].as_array().expect("primitives");
            assert!(!primitives.is_empty(), "mesh {i} has no primitives");
            let targets = |primitive: &Value| primitive["targets"].as_array().map_or(0, Vec::len);
            for primitive in primitives {
                self.check_primitive(i, primitive);
                assert_eq!(targets(primitive), targets(&primitives[0]), "mesh {i}");
            }
            let weights = mesh["weights"].as_array().map_or(0, Vec::len);
            assert!(weights == 0 || weights == targets(&primitives[0]), "mesh {i} has {weights} weights");
        }
        self.check_surfaces();
        self.check_animations();
        self.check_extensions();
    }

    fn check_buffers(&self) {
        let [buffer] = self.list("buffers") else { panic!("one buffer") };
        let length = number(&buffer["byteLength"]);
        assert!(buffer["uri"].is_null() && length <= self.binary.len() && length + 3 >= self.binary.len());
        for (i, view) in self.list("bufferViews").iter().enumerate() {
            assert_eq!(index(&view["buffer"]), Some(0), "view {i}");
            let (start, size) = (number(&view["byteOffset"]), number(&view["byteLength"]));
            assert!(size > 0 && start + size <= length, "view {i}: {view} in {length}");
            if let Some(stride) = view["byteStride"].as_u64() {
                assert!((4..=252).contains(&stride) && stride % 4 == 0, "view {i}");
            }
        }
    }

    fn check_accessor(&self, i: usize, accessor: &Value) {
        let (count, size) = (number(&accessor["count"]), component_size(accessor));
        assert!(count > 0, "accessor {i} is empty");
        let Some(view) = index(&accessor["bufferView"]) else { return };
        let view = self.list("bufferViews").get(view).unwrap_or_else(|| panic!("accessor {i}: no view {view}"));
        let element = size * components(accessor);
        let stride = view["byteStride"].as_u64().map_or(element, |stride| stride as usize);
        let offset = number(&accessor["byteOffset"]);
        assert_eq!(
            (offset % size, (offset + number(&view["byteOffset"])) % size),
            (0, 0),
            "accessor {i} is not aligned"
        );
        assert!(offset + (count - 1) * stride + element <= number(&view["byteLength"]), "accessor {i} leaves its view");
        assert!(accessor["sparse"].is_null() || number(&accessor["sparse"]["count"]) <= count, "accessor {i}");
        if !accessor["sparse"].is_null() {
            return;
        }
        let values = self.floats(i);
        let float = accessor["componentType"] == 5126;
        assert!(!float || values.iter().flatten().all(|x| x.is_finite()), "accessor {i} has NaN");
        let fold = |k: usize, pick: fn(f64, f64) -> f64| values.iter().map(|value| value[k]).reduce(pick);
        for (key, pick) in [("min", f64::min as fn(f64, f64) -> f64), ("max", f64::max)] {
            for (k, bound) in accessor[key].as_array().into_iter().flatten().enumerate() {
                let bound = bound.as_f64().expect("a number");
                // Bounds are rounded to the component type.
                let bound = if float { f64::from(bound as f32) } else { bound };
                assert_eq!(Some(bound), fold(k, pick), "{key} {k} of accessor {i}");
            }
        }
    }

    fn check_primitive(&self, mesh: usize, primitive: &Value) {
        let accessors = self.list("accessors");
        let attributes = primitive["attributes"].as_object().expect("attributes");
        let accessor = |value: &Value| {
            let i = index(value).expect("an index");
            (i, accessors.get(i).unwrap_or_else(|| panic!("mesh {mesh}: no accessor {i}")))
        };
        let (positions, position) = accessor(&attributes["POSITION"]);
        assert!(position["type"] == "VEC3" && position["min"].is_array() && position["max"].is_array(), "mesh {mesh}");
        let vertices = number(&position["count"]);
        let quantized = self.list("extensionsRequired").contains(&"KHR_mesh_quantization".into());
        for (name, value) in attributes {
            let (i, own) = accessor(value);
            assert_eq!(number(&own["count"]), vertices, "mesh {mesh}: {name}");
            let kinds: &[&str] = match name.split('_').next() {
                Some("POSITION" | "NORMAL") => &["VEC3"],
                Some("TANGENT" | "JOINTS" | "WEIGHTS") => &["VEC4"],
                Some("TEXCOORD") => &["VEC2"],
                Some("COLOR") => &["VEC3", "VEC4"],
                _ => &["SCALAR", "VEC2", "VEC3", "VEC4"],
            };
            assert!(kinds.iter().any(|kind| own["type"] == *kind), "mesh {mesh}: {name} is {}", own["type"]);
            let geometry = ["POSITION", "NORMAL", "TANGENT"].contains(&name.as_str());
            assert!(!geometry || quantized || own["componentType"] == 5126, "mesh {mesh}: {name}");
            if (name == "NORMAL" || name == "TANGENT") && own["componentType"] == 5126 {
                for value in self.floats(i) {
                    let length = value[..3].iter().map(|x| x * x).sum::<f64>();
                    assert!((length - 1.0).abs() < 2e-3, "mesh {mesh}: {name} {value:?}");
                    assert!(value.len() == 3 || value[3].abs() == 1.0, "mesh {mesh}: {name} {value:?}");
                }
            }
        }
        for (set, expected) in (0..8).map(|set| format!("TEXCOORD_{set}")).enumerate() {
            let before = set == 0 || attributes.contains_key(&format!("TEXCOORD_{}", set - 1));
            assert!(before || !attributes.contains_key(&expected), "mesh {mesh}: sets of coordinates have a gap");
        }
        if !primitive["indices"].is_null() {
            let (i, indices) = accessor(&primitive["indices"]);
            let most = match indices["componentType"].as_u64() {
                Some(5121) => 255,
                Some(5123) => 65535,
                Some(5125) => u32::MAX as usize,
                other => panic!("mesh {mesh}: indices of type {other:?}"),
            };
            assert_eq!(indices["type"], "SCALAR");
            assert!(self.floats(i).iter().all(|v| (v[0] as usize) < vertices && (v[0] as usize) < most), "mesh {mesh}");
        }
        let count = match index(&primitive["indices"]) {
            Some(indices) => number(&accessors[indices]["count"]),
            None => vertices,
        };
        assert!(primitive["mode"].as_u64().unwrap_or(4) != 4 || count % 3 == 0 && count > 0, "mesh {mesh}");
        assert!(positions < accessors.len());
        if let Some(material) = index(&primitive["material"]) {
            let material = self.list("materials").get(material).unwrap_or_else(|| panic!("no material {material}"));
            for_each_texture(material, &mut |info| {
                let moved = info.get("extensions").and_then(|own| own["KHR_texture_transform"]["texCoord"].as_u64());
                let set = moved.or_else(|| info.get("texCoord")?.as_u64()).unwrap_or(0);
                assert!(attributes.contains_key(&format!("TEXCOORD_{set}")), "mesh {mesh} has no coordinates {set}");
            });
        }
    }

    fn check_nodes(&self) {
        let nodes = self.list("nodes");
        let mut parents = vec![0; nodes.len()];
        for (i, node) in nodes.iter().enumerate() {
            let within = |key: &str, list: &str| {
                let index = index(&node[key]);
                assert!(index.is_none_or(|index| index < self.list(list).len()), "node {i}: {key} {index:?}");
            };
            within("mesh", "meshes");
            within("skin", "skins");
            within("camera", "cameras");
            assert!(node["skin"].is_null() || !node["mesh"].is_null(), "node {i} has a skin and no mesh");
            assert!(node["weights"].is_null() || !node["mesh"].is_null(), "node {i} has weights and no mesh");
            let children = node["children"].as_array();
            assert!(children.is_none_or(|children| !children.is_empty()), "node {i} has an empty list of children");
            for child in children.into_iter().flatten() {
                parents[index(child).expect("an index")] += 1;
            }
        }
        assert!(parents.iter().all(|&n| n <= 1), "a node has two parents");
        for scene in self.list("scenes") {
            let roots: Vec<usize> = scene["nodes"].as_array().into_iter().flatten().filter_map(index).collect();
            assert!(roots.iter().all(|&root| parents[root] == 0), "a node of a scene has a parent");
            assert_eq!(roots.iter().collect::<BTreeSet<_>>().len(), roots.len(), "a node is twice in a scene");
        }
        assert!(index(&self.root["scene"]).is_none_or(|scene| scene < self.list("scenes").len()));
    }

    fn check_surfaces(&self) {
        let textures = self.list("textures");
        for material in self.list("materials") {
            for_each_texture(material, &mut |info| {
                let i = index(&info["index"]).expect("an index");
                assert!(i < textures.len(), "no texture {i} for {material}");
            });
        }
        for texture in textures {
            let within = |key: &str, list: &str| index(&texture[key]).is_none_or(|index| index < self.list(list).len());
            assert!(within("source", "images") && within("sampler", "samplers"), "{texture}");
        }
        for (i, image) in self.list("images").iter().enumerate() {
            assert_ne!(image["uri"].is_null(), image["bufferView"].is_null(), "image {i} is in one place");
            if !image["uri"].is_null() {
                continue;
            }
            let bytes = self.image(i);
            let known = match image["mimeType"].as_str().expect("a media type") {
                "image/png" => bytes.starts_with(b"\x89PNG\r\n\x1a\n"),
                "image/jpeg" => bytes.starts_with(b"\xff\xd8\xff"),
                _ => true,
            };
            assert!(known, "image {i} is no {}", image["mimeType"]);
        }
    }

    fn check_animations(&self) {
        let accessors = self.list("accessors");
        for skin in self.list("skins") {
            let joints = skin["joints"].as_array().expect("joints");
            assert!(
                !joints.is_empty() && joints.iter().all(|j| index(j).is_some_and(|j| j < self.list("nodes").len()))
            );
        }
        for animation in self.list("animations") {
            let samplers = animation["samplers"].as_array().expect("samplers");
            for sampler in samplers {
                for key in ["input", "output"] {
                    assert!(index(&sampler[key]).is_some_and(|index| index < accessors.len()), "{animation}");
                }
            }
            let channels = animation["channels"].as_array().expect("channels");
            assert!(!channels.is_empty());
            for channel in channels {
                assert!(index(&channel["sampler"]).is_some_and(|index| index < samplers.len()), "{animation}");
                assert!(index(&channel["target"]["node"]).is_none_or(|node| node < self.list("nodes").len()));
            }
        }
    }

    fn check_extensions(&self) {
        let names = |key: &str| -> BTreeSet<&str> { self.list(key).iter().filter_map(Value::as_str).collect() };
        let (used, required) = (names("extensionsUsed"), names("extensionsRequired"));
        assert!(required.is_subset(&used), "{required:?} are required and not used");
        let mut found = BTreeSet::new();
        collect_extensions(&self.root, &mut found);
        let unlisted: Vec<_> = found.iter().filter(|name| !used.contains(name.as_str())).collect();
        assert!(unlisted.is_empty(), "{unlisted:?} are not listed");
    }
}

fn collect_extensions(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            found.extend(
                fields.get("extensions").and_then(Value::as_object).into_iter().flat_map(|own| own.keys().cloned()),
            );
            fields.iter().filter(|(key, _)| *key != "extras").for_each(|(_, value)| collect_extensions(value, found));
        }
        Value::Array(values) => values.iter().for_each(|value| collect_extensions(value, found)),
        _ => {}
    }
}

fn for_each_texture(value: &Value, with: &mut dyn FnMut(&Map<String, Value>)) {
    for (key, value) in value.as_object().into_iter().flatten() {
        if let Some(info) = value.as_object().filter(|info| key.ends_with("Texture") && info.contains_key("index")) {
            with(info);
        }
        for_each_texture(value, with);
    }
}

/// The index that a value is.
pub fn index(value: &Value) -> Option<usize> {
    value.as_u64().map(|index| index as usize)
}

fn number(value: &Value) -> usize {
    value.as_u64().map_or(0, |n| n as usize)
}

fn component_size(accessor: &Value) -> usize {
    match accessor["componentType"].as_u64() {
        Some(5120 | 5121) => 1,
        Some(5122 | 5123) => 2,
        Some(5125 | 5126) => 4,
        other => panic!("component type {other:?}"),
    }
}

fn components(accessor: &Value) -> usize {
    match accessor["type"].as_str() {
        Some("SCALAR") => 1,
        Some("VEC2") => 2,
        Some("VEC3") => 3,
        Some("VEC4" | "MAT2") => 4,
        Some("MAT3") => 9,
        Some("MAT4") => 16,
        other => panic!("type {other:?}"),
    }
}
