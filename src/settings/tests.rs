use super::*;

fn refusal(text: &str) -> SettingsError {
    CoatingSettings::from_ron(text, "barrel.coating.ron").expect_err(text)
}

/// A value that is in the setting's range, but not its default.
fn another_value(field: &Field) -> f32 {
    let default = field.get(&CoatingSettings::default());
    if !field.names.is_empty() {
        1.0 - default
    } else if field.range.whole {
        default + 1.0
    } else {
        0.5 * default + 0.011
    }
}

#[test]
fn defaults_are_those_of_the_method() {
    let expected = "(scale:(rules:Grain,grain:0.028),\
        adhesion:(mean:2.1,deviation:0.7,octaves:2,frequency:5.0,wavelength:7.2,decay:1.0),\
        bending:(gain:0.33333334,gamma:2.0),\
        tearing:(contraction:1.0,contraction_growth:1.0,contraction_kept:0.3,relief:0.95,relief_reach:0.6,memory:1.8,\
        neck_width:1.0,binding:6.0,binding_decay:1.3,\
        weak_probability:0.01,weak_factor:0.001,alpha:0.45,beta:0.2),\
        deform:(narrowing_rate:0.7,bend_limit:0.35,curl_reach:2.0,sweeps_per_age:10000.0),\
        stripping:(fall_faces:6,hold:0.02,hold_area:2.5),\
        rust:(emission:0.08,speed:1.5,deposit:4.0,spread:0.05,into_cracks:0.5,corrosion:4.0),\
        dust:(rate:1.2,height:0.4,direction:0.8,curvature:1.0),\
        moisture:(wetting:60.0,drying:15.0,sun:1.0,crevice:0.25,adhesion:1.0,emission:1.0,travel:0.5,\
        wash_dust:2.0,wash_rust:0.0))";
    assert_eq!(ron::to_string(&CoatingSettings::default()).unwrap(), expected);
}

#[test]
fn every_default_is_valid() {
    assert_eq!(CoatingSettings::default().validate(), Ok(()));
}

#[test]
fn every_row_of_the_table_reaches_its_own_field() {
    let default = serde_json::to_value(CoatingSettings::default()).unwrap();
    for field in CoatingSettings::fields() {
        let value = another_value(field);
        let mut settings = CoatingSettings::default();
        let text = field.names.get(value as usize).map_or(value.to_string(), |name| (*name).to_owned());
        settings.set(field.path, &text).unwrap();
        assert_eq!(field.get(&settings), value, "{}", field.path);
        assert_eq!(field.text(&settings), text);

        // Serde sees that change at that path, and nowhere else.
        let pointer = format!("/{}", field.path.replace('.', "/"));
        let mut seen = serde_json::to_value(&settings).unwrap();
        let changed = seen.pointer_mut(&pointer).unwrap_or_else(|| panic!("no {pointer}"));
        match field.names {
            [] => assert_eq!(changed.as_f64().unwrap() as f32, value, "{}", field.path),
            names => assert_eq!(changed.as_str(), Some(names[value as usize])),
        }
        *changed = default.pointer(&pointer).unwrap().clone();
        assert_eq!(seen, default, "{}", field.path);
    }
}

#[test]
fn the_table_misses_no_field() {
    let serde_json::Value::Object(stages) = serde_json::to_value(CoatingSettings::default()).unwrap() else {
        panic!("settings are a struct")
    };
    let mut paths: Vec<String> = stages
        .iter()
        .flat_map(|(stage, fields)| fields.as_object().unwrap().keys().map(move |field| format!("{stage}.{field}")))
        .collect();
    let mut table: Vec<_> = CoatingSettings::fields().map(|field| field.path).collect();
    paths.sort();
    table.sort_unstable();
    assert_eq!(table, paths);
}

#[test]
fn every_field_refuses_what_is_out_of_its_range() {
    for field in CoatingSettings::fields().filter(|field| field.names.is_empty()) {
        for (value, text) in [
            (f32::NAN, "NaN"),
            (f32::INFINITY, "inf"),
            (f32::NEG_INFINITY, "-inf"),
            (field.range.min - 1.0, ""),
            (field.range.max * 1.001, ""),
        ] {
            let text = if text.is_empty() { value.to_string() } else { text.to_string() };
            let (stage, name) = field.path.split_once('.').unwrap();
            let ron = format!(
                "({stage}: ({name}: {}))",
                if value.fract() == 0.0 { format!("{value:.1}") } else { text.clone() }
            );
            let mut set = CoatingSettings::default();
            for error in [set.set(field.path, &text).unwrap_err(), refusal(&ron)] {
                let SettingsErrorKind::OutOfRange { field: path, range, .. } = &error.kind else {
                    panic!("{ron}: {error:?}")
                };
                assert_eq!((*path, *range), (field.path, field.range));
                let message = error.to_string();
                assert!(message.contains(&format!("setting `{}` is {text}", field.path)), "{message}");
                assert!(message.contains(&format!("range is {}", field.range)), "{message}");
            }
            assert_eq!(set, CoatingSettings::default(), "a refused value changes nothing");
        }
    }
}

#[test]
fn ranges_include_their_ends_unless_open() {
    for field in CoatingSettings::fields() {
        for end in [field.range.min, field.range.max] {
            assert_eq!(field.range.contains(end), !field.range.open, "{} {end}", field.path);
            assert!(field.doc.len() > 20, "{} has no documentation", field.path);
        }
    }
}

#[test]
fn validate_finds_a_field_that_was_set_by_hand() {
    let mut settings = CoatingSettings::default();
    settings.tearing.alpha = f32::NAN;
    assert_eq!(
        settings.validate().unwrap_err().to_string(),
        "setting `tearing.alpha` is NaN, but its range is -1 to 1 (both excluded)"
    );
    settings.tearing.alpha = 0.5;
    settings.adhesion.octaves = u32::MAX;
    let message = settings.validate().unwrap_err().to_string();
    assert!(message.ends_with("but its range is 1 to 8 (whole numbers)"), "{message}");
}

#[test]
fn a_file_may_leave_everything_out() {
    assert_eq!(CoatingSettings::from_ron("()", "x"), Ok(CoatingSettings::default()));
    let settings =
        CoatingSettings::from_ron("// thin\nCoatingSettings(tearing: (beta: 0.3,), bending: ())", "x").unwrap();
    let mut expected = CoatingSettings::default();
    expected.tearing.beta = 0.3;
    assert_eq!(settings, expected);
}

#[test]
fn refusals_of_a_file_name_file_place_setting_and_range() {
    for (text, message) in [
        (
            "(\n  tearing: (\n    alpha: 1.5,\n  ),\n)",
            "barrel.coating.ron:3:12: setting `tearing.alpha` is 1.5, but its range is -1 to 1 (both excluded)",
        ),
        (
            "(adhesion: (octaves: -1))",
            "barrel.coating.ron:1:22: setting `adhesion.octaves` is -1, but its range is 1 to 8 (whole numbers)",
        ),
        (
            "(adhesion: (octaves: 2.5))",
            "barrel.coating.ron:1:22: setting `adhesion.octaves` is 2.5, but its range is 1 to 8 (whole numbers)",
        ),
        (
            "(tearing: (beta: \"low\"))",
            "barrel.coating.ron:1:17: setting `tearing.beta` must be a number in its range of 0 to 1: Expected float",
        ),
        (
            "(\n  bending: (gama: 2.0),\n)",
            "barrel.coating.ron:2:13: there is no setting `bending.gama`; known here: bending.gain, bending.gamma",
        ),
        (
            "(soot: (rate: 2.0))",
            "barrel.coating.ron:1:2: there is no setting `soot`; known here: scale, adhesion, bending, tearing, \
             deform, stripping, rust, dust, moisture",
        ),
        ("(bending: (gain: 1.0, gain: 1.0))", "barrel.coating.ron:1:23: setting `bending.gain` is given twice"),
        ("(bending: (), bending: ())", "barrel.coating.ron:1:15: setting `bending` is given twice"),
        ("(bending: (gain: 1.0)", "barrel.coating.ron:1:21: Expected comma"),
        ("[1]", "barrel.coating.ron:1:1: Expected opening `(` for struct `CoatingSettings`"),
        ("() ()", "barrel.coating.ron:1:3: Non-whitespace trailing characters"),
    ] {
        assert_eq!(refusal(text).to_string(), message, "{text}");
    }
    for broken in ["", "(", "(tearing", "(tearing:", "(tearing: (beta:", "\u{0}", "(tearing: 3)", "((((((((", "{}"] {
        assert_eq!(refusal(broken).position.unwrap().file, "barrel.coating.ron", "{broken}");
    }
}

#[test]
fn set_refuses_what_it_does_not_know() {
    let mut settings = CoatingSettings::default();
    let unknown = settings.set("tearing.gamma", "1").unwrap_err();
    let SettingsErrorKind::UnknownField { path, known } = &unknown.kind else { panic!("{unknown:?}") };
    assert_eq!(path, "tearing.gamma");
    assert_eq!(known.len(), CoatingSettings::fields().count());
    assert!(unknown.to_string().contains("bending.gamma, tearing.contraction"), "{unknown}");

    let malformed = settings.set("tearing.beta", "0,3").unwrap_err().to_string();
    assert_eq!(malformed, "setting `tearing.beta` must be a number in its range of 0 to 1: found `0,3`");
    assert_eq!(settings, CoatingSettings::default());
    settings.set("stripping.fall_faces", " 0 ").unwrap();
    assert_eq!(settings.stripping.fall_faces, 0);
}

#[test]
fn settings_survive_every_kind_of_format() {
    let mut settings = CoatingSettings::default();
    for field in CoatingSettings::fields() {
        field.set(&mut settings, another_value(field)).unwrap();
    }
    let text = ron::ser::to_string_pretty(&settings, Default::default()).unwrap();
    assert_eq!(CoatingSettings::from_ron(&text, "x"), Ok(settings.clone()));
    let text = serde_json::to_string(&settings).unwrap();
    assert_eq!(serde_json::from_str::<CoatingSettings>(&text).unwrap(), settings);
    // As formats without names do.
    let value = |field: &Field| match field.names {
        [] => serde_json::json!(field.get(&settings)),
        _ => serde_json::json!(field.text(&settings)),
    };
    let rows: Vec<Vec<_>> = rows::STAGES.iter().map(|stage| stage.fields.iter().map(value).collect()).collect();
    let text = serde_json::to_string(&rows).unwrap();
    assert_eq!(serde_json::from_str::<CoatingSettings>(&text).unwrap(), settings);
    assert!(serde_json::from_str::<CoatingSettings>("[[1.0]]").is_err(), "too short");
}

#[test]
fn every_preset_is_valid_and_round_trips() {
    for preset in Preset::ALL {
        let name = preset.name();
        let settings = CoatingSettings::from_ron(preset.ron(), name).unwrap();
        assert_eq!(CoatingSettings::from(preset), settings);
        assert_eq!(name.parse(), Ok(preset));
        settings.validate().unwrap();
        let text = ron::to_string(&settings).unwrap();
        assert_eq!(CoatingSettings::from_ron(&text, name).unwrap(), settings);
    }
}

#[test]
fn presets_change_what_they_say() {
    assert_eq!(CoatingSettings::preset("default").unwrap(), CoatingSettings::default());
    for (name, changes) in [
        (
            "few_cracks",
            &[
                ("tearing.beta", "0.3"),
                ("tearing.binding_decay", "2"),
                ("tearing.weak_probability", "0.002"),
                ("tearing.alpha", "0.6"),
            ][..],
        ),
        (
            "gentle",
            &[
                ("adhesion.decay", "0.6"),
                ("tearing.contraction_growth", "0.5"),
                ("tearing.binding_decay", "1"),
                ("deform.bend_limit", "0.25"),
            ],
        ),
        (
            "heavy",
            &[
                ("adhesion.decay", "1.15"),
                ("tearing.contraction_growth", "1.25"),
                ("tearing.binding_decay", "1.45"),
                ("adhesion.mean", "2"),
                ("deform.bend_limit", "0.4"),
            ],
        ),
        (
            "harsh",
            &[
                ("adhesion.decay", "1.3"),
                ("tearing.contraction_growth", "1.5"),
                ("tearing.binding_decay", "1.6"),
                ("adhesion.mean", "1.9"),
                ("deform.bend_limit", "0.4"),
            ],
        ),
        ("paper", &[("scale.rules", "Paper")]),
        (
            "chalky_whitewash",
            &[
                ("adhesion.mean", "2.0"),
                ("adhesion.deviation", "0.5"),
                ("adhesion.octaves", "4"),
                ("adhesion.wavelength", "5.0"),
                ("adhesion.decay", "0.8"),
                ("tearing.relief", "0.8"),
                ("tearing.relief_reach", "0.4"),
                ("tearing.memory", "0.8"),
                ("tearing.weak_probability", "0.03"),
                ("tearing.alpha", "0.2"),
                ("tearing.beta", "0.18"),
                ("deform.narrowing_rate", "0.2"),
                ("deform.bend_limit", "0.08"),
                ("stripping.hold", "0.005"),
                ("stripping.hold_area", "3.5"),
                ("rust.emission", "0.01"),
                ("rust.corrosion", "1.5"),
                ("dust.rate", "0.7"),
            ],
        ),
        (
            "desert_sun",
            &[
                ("scale.grain", "0.018"),
                ("adhesion.mean", "2.6"),
                ("adhesion.deviation", "0.6"),
                ("adhesion.decay", "0.9"),
                ("tearing.contraction_growth", "1.4"),
                ("tearing.relief_reach", "0.5"),
                ("tearing.weak_probability", "0.02"),
                ("tearing.binding_decay", "1.8"),
                ("deform.bend_limit", "0.3"),
                ("rust.emission", "0.005"),
                ("rust.corrosion", "0.4"),
                ("dust.rate", "2.5"),
                ("dust.height", "0.2"),
                ("dust.direction", "1.0"),
                ("moisture.drying", "60.0"),
                ("moisture.sun", "3.0"),
            ],
        ),
        (
            "fresh_enamel",
            &[
                ("adhesion.mean", "2.4"),
                ("adhesion.deviation", "0.6"),
                ("adhesion.decay", "0.7"),
                ("tearing.contraction_growth", "0.6"),
                ("tearing.binding_decay", "1.0"),
                ("deform.bend_limit", "0.2"),
                ("rust.emission", "0.015"),
                ("rust.corrosion", "2.0"),
                ("dust.rate", "0.4"),
            ],
        ),
        (
            "marine",
            &[
                ("adhesion.decay", "1.1"),
                ("tearing.weak_probability", "0.02"),
                ("tearing.binding_decay", "1.5"),
                ("rust.emission", "0.3"),
                ("rust.speed", "2.0"),
                ("rust.deposit", "3.0"),
                ("rust.corrosion", "12.0"),
                ("dust.rate", "0.5"),
                ("moisture.drying", "8.0"),
                ("moisture.crevice", "0.1"),
                ("moisture.adhesion", "2.0"),
                ("moisture.emission", "3.0"),
            ],
        ),
        (
            "old_lead_paint",
            &[
                ("scale.grain", "0.036"),
                ("adhesion.wavelength", "6.0"),
                ("adhesion.decay", "1.1"),
                ("tearing.relief_reach", "0.8"),
                ("tearing.alpha", "0.4"),
                ("deform.narrowing_rate", "1.0"),
                ("deform.bend_limit", "0.5"),
                ("deform.curl_reach", "2.5"),
                ("stripping.hold_area", "1.0"),
                ("rust.emission", "0.05"),
            ],
        ),
        (
            "powder_coat",
            &[
                ("scale.grain", "0.036"),
                ("adhesion.mean", "2.2"),
                ("adhesion.deviation", "0.9"),
                ("adhesion.octaves", "1"),
                ("adhesion.wavelength", "10.0"),
                ("tearing.relief_reach", "1.0"),
                ("tearing.memory", "4.0"),
                ("tearing.weak_probability", "0.003"),
                ("tearing.alpha", "0.6"),
                ("tearing.beta", "0.25"),
                ("deform.bend_limit", "0.2"),
                ("deform.curl_reach", "4.0"),
                ("rust.emission", "0.05"),
                ("dust.rate", "0.8"),
            ],
        ),
    ] {
        let mut expected = CoatingSettings::default();
        for (path, value) in changes {
            expected.set(path, value).unwrap();
        }
        assert_eq!(CoatingSettings::preset(name).unwrap(), expected, "{name}");
    }
    let unknown = CoatingSettings::preset("rusty").unwrap_err().to_string();
    assert_eq!(unknown, format!("there is no preset `rusty`; there are {}", Preset::ALL.map(Preset::name).join(", ")));
}

#[test]
fn every_preset_file_is_built_in() {
    let folder = "assets/presets";
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    // Masks are beside them.
    files.retain(|file| file.ends_with(".coating.ron"));
    files.sort();
    assert_eq!(files, Preset::ALL.map(|preset| format!("{preset}.coating.ron")));
}

#[test]
fn the_guide_lists_every_setting() {
    let guide = std::fs::read_to_string("docs/settings.md").unwrap();
    let rows: Vec<_> = guide.lines().skip_while(|line| !line.starts_with("| setting |")).skip(2).collect();
    for (field, row) in CoatingSettings::fields().zip(rows) {
        let expected =
            format!("| `{}` | {} | {} | ", field.path, field.text(&CoatingSettings::default()), field.allowed());
        assert!(row.starts_with(&expected), "{row}\nshould start with\n{expected}");
    }
    for name in Preset::ALL.map(Preset::name) {
        assert!(guide.contains(&format!("| `{name}` | ")), "{name}");
    }
}

#[test]
fn settings_with_names_are_read_by_name() {
    let read = |text: &str| CoatingSettings::from_ron(text, "a").map(|settings| settings.scale.rules);
    assert_eq!(read("(scale: (rules: Grain))"), Ok(Rules::Grain));
    for text in ["(scale: (rules: Metres))", "(scale: (rules: 1))"] {
        let error = read(text).unwrap_err();
        assert!(matches!(error.kind, SettingsErrorKind::UnknownName { .. }), "{text}: {error}");
        assert!(error.to_string().contains("setting `scale.rules` must be one of Paper, Grain"), "{error}");
    }
    assert!(CoatingSettings::default().set("scale.rules", "metres").is_err());
}
