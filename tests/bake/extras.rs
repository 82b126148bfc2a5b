//! Custom properties and masks that the program reads.

use std::fs;

use serde_json::Value;

use crate::tool::{QUICK, bake, baked, folder, number, stats};

fn model(folder: &std::path::Path) {
    fs::copy("assets/props/custom_properties.glb", folder.join("yard.glb")).expect("the model");
}

fn last(stats: &Value) -> &Value {
    stats["timeline"].as_array().and_then(|ages| ages.last()).expect("an age")
}

#[test]
fn custom_properties_say_how_a_model_is_painted() {
    let folder = folder();
    model(folder.path());
    let arguments = [&["yard.glb", "--out", "aged.glb"][..], &QUICK].concat();
    let output = baked(folder.path(), &arguments);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(errors.contains("misspelt: is left as it is") && errors.contains("`hrash`"), "{errors}");
    assert!(errors.contains("powder_coat"), "the choices are listed: {errors}");

    let own = stats(folder.path(), &[&["yard.glb"][..], &QUICK].concat());
    let plain = stats(folder.path(), &[&["yard.glb", "--ignore-extras"][..], &QUICK].concat());
    // The cabinet, its drawer, the rail, the panel and the stone; without extras the window and the misspelt one, too.
    let films = |stats: &Value| stats["film"]["grain"].as_array().map(Vec::len);
    assert_eq!((films(&own), films(&plain)), (Some(5), Some(7)));
    let grains: Vec<f64> = own["film"]["grain"].as_array().expect("grains").iter().map(number).collect();
    assert!(grains.iter().any(|grain| (grain - 0.036).abs() < 1e-3), "the panel is powder-coated: {grains:?}");
    assert_ne!(own["digest"], plain["digest"]);
    let again = stats(folder.path(), &[&["yard.glb"][..], &QUICK].concat());
    assert_eq!(own["digest"], again["digest"]);
}

#[test]
fn masks_from_files_and_in_short_make_paint_weak() {
    let folder = folder();
    let mut image = Vec::new();
    let mut encoder = png::Encoder::new(&mut image, 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().and_then(|mut png| png.write_image_data(&[0, 255])).expect("a PNG");
    fs::create_dir(folder.path().join("masks")).expect("a folder");
    fs::write(folder.path().join("masks/wear.png"), image).expect("the image");
    let list = r#"[(mask: Texture((image: "wear.png")), effect: (adhesion: (1.0, 0.2), dust: (0.0, 1.0)))]"#;
    fs::write(folder.path().join("masks/wear.masks.ron"), list).expect("the masks");
    let run = |more: &[&str]| {
        let arguments = [&["plate:400", "--age", "0.2"][..], more, &QUICK].concat();
        stats(folder.path(), &arguments)
    };
    let off = |stats: &Value| number(&last(stats)["separated"]);
    let plain = run(&[]);
    let by_file = run(&["--mask", "masks/wear.masks.ron"]);
    let short = run(&["--mask", "masks/wear.png:adhesion=1..0.2,dust=0..1"]);
    assert!(off(&by_file) > off(&plain) + 0.2, "{} for {}", off(&by_file), off(&plain));
    assert_eq!(by_file["digest"], short["digest"], "both say the same");
    let edges = run(&["--mask", "edges:adhesion=1..0", "--mask", "lower:rust=0..1"]);
    assert!(off(&edges) > off(&plain) && number(&last(&edges)["rust_stained"]) > 0.05);
    assert_eq!(run(&["--mask", "edges:adhesion=1..1"])["digest"], plain["digest"], "no effect, no change");
}

#[test]
fn masks_that_are_none_are_named_with_the_way_out() {
    let folder = folder();
    fs::write(folder.path().join("wrong.ron"), "[(mask: Egdes(), effect: ())]").expect("a file");
    fs::write(folder.path().join("text.png"), "no image").expect("a file");
    for (mask, parts) in [
        ("edges", &["there is no `:`", "wear.png:adhesion=1..0.2"][..]),
        ("edges:adhesion", &["no `=`"]),
        ("edges:adhesion=1", &["two numbers"]),
        ("edges:glue=1..0", &["`glue`", "adhesion, binding"]),
        ("edges:dust=0..2", &["`dust`", "0 to 1"]),
        ("edegs:dust=0..1", &["edegs: cannot be read"]),
        ("text.png:dust=0..1", &["text.png: is no image for a mask", "PNG or JPEG"]),
        ("wrong.ron", &["wrong.ron:1:", "Edges"]),
        ("missing.ron", &["missing.ron: cannot be read"]),
        ("color:dust=0..1", &["mesh \"plate\"", "vertex colours"]),
    ] {
        let output = bake(folder.path(), &["plate:50", "--mask", mask, "--stats", "out.json"]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{mask}: {errors}");
        assert!(parts.iter().all(|part| errors.contains(part)) && errors.lines().count() == 1, "{mask}: {errors}");
        assert!(!folder.path().join("out.json").exists());
    }
    // What is read is not written over.
    fs::write(folder.path().join("good.ron"), "[]").expect("a file");
    let output = bake(folder.path(), &["plate:50", "--mask", "good.ron", "--stats", "good.ron"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("good.ron")).expect("the masks"), "[]");
}
