use super::{ExtrasError, PropCoating, PropExtras};
use crate::settings::{CoatingSettings, Preset};

fn coat(json: &str) -> PropCoating {
    match PropExtras::read(json) {
        Ok(Some(PropExtras::Coat(coating))) => *coating,
        other => panic!("{json}: {other:?}"),
    }
}

#[test]
fn presets_settings_seed_and_age_are_read() {
    let coating = coat(
        r#"{
            "coating_start_age": 0.6, "coating.tearing.beta": 0.3, "coating": "marine", "coating_seed": 12.0,
            "coating.scale.rules": "Paper", "coating.stripping.fall_faces": 3, "Cycles": { "a": [1, 2] }
        }"#,
    );
    let mut expected = CoatingSettings::from(Preset::Marine);
    expected.set("tearing.beta", "0.3").unwrap();
    expected.set("scale.rules", "Paper").unwrap();
    expected.set("stripping.fall_faces", "3").unwrap();
    let preset = Preset::Marine;
    assert_eq!(coating, PropCoating { preset, settings: expected, seed: Some(12), start_age: Some(0.6) });
    assert_eq!(coat(r#"{ "coating": true }"#).settings, CoatingSettings::default());
    // As Blender writes 1.8 in single precision.
    assert_eq!(coat(r#"{ "coating.adhesion.mean": 1.7999999523162842 }"#).settings.adhesion.mean, 1.8);
    assert_eq!(coat(r#"{ "coating_seed": 18446744073709551615 }"#).seed, Some(u64::MAX));
}

#[test]
fn other_properties_do_not_matter() {
    for json in ["{}", "null", "3", "[1]", "\"coating\"", r#"{ "coat": 3, "my coating": true, "": {} }"#] {
        assert_eq!(PropExtras::read(json), Ok(None), "{json}");
    }
    for json in [r#"{ "coating": false, "coating_seed": 1 }"#, r#"{ "coating": "none" }"#] {
        assert_eq!(PropExtras::read(json), Ok(Some(PropExtras::Exclude)), "{json}");
    }
}

#[test]
fn what_cannot_be_used_is_named_with_the_choices() {
    let refusal = |json: &str| PropExtras::read(json).unwrap_err().to_string();
    for (json, parts) in [
        (r#"{ "coating": "hrash" }"#, &["`coating`", "`hrash`", "harsh"][..]),
        (r#"{ "coating": 3 }"#, &["`coating`", "the name of a preset", "3"]),
        (r#"{ "coating.adhesion.meen": 1 }"#, &["`coating.adhesion.meen`", "adhesion.mean"]),
        (r#"{ "coating.adhesion.mean": -1 }"#, &["0 to 100"]),
        (r#"{ "coating.adhesion.mean": "much" }"#, &["`much`", "0 to 100"]),
        (r#"{ "coating.adhesion.mean": [1] }"#, &["a number or a name", "[1]"]),
        (r#"{ "coating.": 1 }"#, &["there is no setting ``"]),
        (r#"{ "coating_seed": -1 }"#, &["a whole number, 0 or more", "-1"]),
        (r#"{ "coating_seed": 1.5 }"#, &["1.5"]),
        (r#"{ "coating_start_age": 11 }"#, &["11", "0 to 10"]),
        (r#"{ "coatings": 11 }"#, &["`coatings`", "coating_seed"]),
        ("{", &["cannot be read"]),
    ] {
        let message = refusal(json);
        assert!(parts.iter().all(|part| message.contains(part)), "{json}: {message}");
    }
    assert!(matches!(PropExtras::read(&"[".repeat(100_000)), Err(ExtrasError::Json(_))), "no stack is left");
}
