//! Lists of objects in the forms that people keep them in.

use proptest::collection;
use proptest::prelude::*;
use rockfrag::inputs::objects::{self, ListDefaults};
use rockfrag::inputs::{InputError, Meaning, Reader, Reading, Rename};
use rockfrag_core::object::{Base, Object, Place, Wall, structure_warnings};
use rockfrag_core::warning::Warning;

use super::packed::csv;

/// Objects of a building with five storeys: name, number, width, depth and height (cm), anchors, and the
/// storey above the ground.
const LIST: [[&str; 7]; 7] = [
    ["Bookcase", "3", "30", "90", "200", "no", "0"],
    ["Shelf", "12", "40", "92.5", "180", "no", "2"],
    ["Autoclave", "1", "80", "80", "170", "yes", "2"],
    ["Drug cabinet", "4", "45", "60", "190", "no", "3"],
    ["Filing cabinet", "8", "41.5", "62", "132", "no", "4"],
    ["#2 rack", "1", "60", "80", "200", "no", "5"],
    ["Tower", "1", "0.5e2", "50", "1.05e2", "no", "3"],
];

fn read(list: &str, columns: &str, ground_floor: Option<u32>) -> Result<Vec<Object>, InputError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(&path, list).unwrap();
    let renames: Vec<Rename> = columns.split_terminator(',').map(|text| text.parse().unwrap()).collect();
    let mut renames = Reader::new(&renames, &[]);
    let defaults = ListDefaults { ground_floor, ..ListDefaults::default() };
    let objects = objects::read(&path, &mut renames, &defaults)?;
    renames.expect_used()?;
    Ok(objects)
}

fn text(text: &str) -> Vec<Object> {
    read(text, "", None).unwrap_or_else(|why| panic!("{why}"))
}

/// Why the only object of a list has no answer.
fn reason(text: &str) -> String {
    let objects = read(text, "", None).unwrap_or_else(|why| panic!("{why}: {text}"));
    objects[0].sides().err().map_or(String::new(), |reason| reason.to_string())
}

#[test]
fn a_list_is_the_same_in_two_languages() {
    let english = "Equipment,Qty,Width (cm),Depth (cm),Height (cm),Anchored,Storey,Storeys,Building";
    let rows: Vec<Vec<&str>> = LIST.iter().map(|row| [&row[..], &["5", "concrete frame"]].concat()).collect();
    let cells = [vec![english.split(',').collect()], rows.clone()].concat();
    let plain = csv(&cells, ",");
    let expected = text(&plain);
    assert_eq!(expected.len(), LIST.len());
    assert_eq!(expected[3].floor.as_deref(), Some("floor 3 of 5"));
    // Storey 3 of 5: 17.5 m high, T1 = .0466 H^.9.
    let place = expected[3].place;
    assert!((place.level.unwrap() - 0.6).abs() < 1e-12);
    assert!((place.period.unwrap() - 0.0466 * 17.5_f64.powf(0.9)).abs() < 1e-12);
    let refused: Vec<bool> = expected.iter().map(|object| object.refused.is_some()).collect();
    assert_eq!(refused, LIST.map(|row| row[5] == "yes"));

    let headings =
        "Bezeichnung;Anzahl;Breite (cm);Tiefe (cm);Höhe (cm);Verankert;Geschoss;Geschosse;Bauweise\n";
    let german = csv(&rows, ";").replace('.', ",").replace(";no;", ";nein;");
    let german = headings.to_string() + &german.replace("concrete frame", "Stahlbeton");

    let mut found = text(&german);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter_mut().zip(&expected) {
        // What is not free has a reason in the words of its list.
        found.refused = found.refused.take().and(expected.refused.clone());
        assert_eq!(found, expected);
    }
    let renamed = plain.replacen("Width (cm)", "Breadth (cm)", 1);
    assert_eq!(read(&renamed, "width=Breadth (cm)", None), Ok(expected));
    let refusal = read(&plain, "width=Breadth (cm)", None);
    assert!(matches!(refusal, Err(InputError::Renamed { .. })));
}

#[test]
fn walls_and_bases_are_words() {
    let list = "name,width,height,wall,base\na,.4,1.8,ja,Timber\nb,.4,1.8,0,\nc,.4,1.8,.3,stone\n";
    let found: Vec<_> = text(list).iter().map(|object| (object.place.wall, object.place.base)).collect();
    let expected =
        [(Some(Wall::Yes), Some(Base::Timber)), (None, None), (Some(Wall::Rebound(0.3)), Some(Base::Stone))];
    assert_eq!(found, expected);
    assert!(reason("name,width,height,base\na,.4,1.8,0.5\n").contains("concrete, stone"));
    for headings in [
        "Pedestal width;Depth of pedestal;Pedestal height;Pedestal mass;Fixed to pedestal",
        "Sockelbreite;Sockeltiefe;Sockelhöhe;Sockelgewicht;Am Sockel befestigt",
        "Larghezza piedistallo;Profondità piedistallo;Altezza piedistallo;Peso piedistallo;Fissa al piedistallo",
        "Largeur socle;Profondeur socle;Hauteur socle;Masse du socle;Fixé au socle",
        "Ancho pedestal;Fondo pedestal;Altura pedestal;Peso pedestal;Fijado al pedestal",
    ] {
        let list = format!("name;width;height;mass;{headings}\na;.3;.6;8;.4;.5;.9;150;sì\nb;.3;.6;;;;;;\n");
        let [a, b] = [0, 1].map(|row| text(&list)[row].clone());
        let found = [a.place.pedestal_width, a.place.pedestal_depth, a.place.pedestal_height];
        assert_eq!(found, [0.4, 0.5, 0.9].map(Some), "{list}");
        assert_eq!([a.place.pedestal_mass, a.place.mass], [150.0, 8.0].map(Some), "{list}");
        assert!(a.place.fixed_to_pedestal == Some(true) && b.place == Place::default());
        assert!(a.on_pedestal().refused.unwrap().to_string().ends_with("missing: depth"));
    }
    let years = |heading: &str| text(&format!("name,width,height,{heading}\na,.3,.6,12.5\n"))[0].years;
    assert_eq!(["Age (ka)", "years", "Age (years)"].map(years), [Some(12_500.0), Some(12.5), None]);
}

#[test]
fn floors_are_read_as_people_write_them() {
    let level = |floor: &str| {
        let list = format!("name,width,height,Floor,Storeys\na,0.5,2,{floor},5\nb,0.5,2,G,5\n");
        let object = &text(&list)[0];
        assert!(object.refused.is_none(), "{floor}: {:?}", object.refused);
        object.place.level
    };
    let ground = ["G", "EG", "GF", "0", "B1", "-1", "UG", "Erdgeschoss", "ground floor", "RDC", "地下1階"];
    for ground in ground.into_iter().chain(["B2", "basement level 1"]) {
        assert_eq!(level(ground), Some(0.0), "{ground}");
    }
    let third = ["3", "3rd", "3rd floor", "3. OG", "3.OG", "3F", "3階", "Level 3", "piano 3", "3e étage"];
    for third in third.into_iter().chain(["3.0", "L3"]) {
        assert_eq!(level(third), Some(0.6), "{third}");
    }
    assert_eq!(level("roof"), Some(1.0));
    // A floor is one number or one name.
    for strange in ["2-3", "1.5", "-1.5", "3.5", "1 & 2", "L2.1", "2nd - 3rd", "L-3", "~3", "basement to 3"] {
        let why = reason(&format!("name,width,height,Floor,Storeys\na,0.5,2,{strange},30\nb,0.5,2,G,30\n"));
        assert!(why.contains(strange), "{strange}: {why}");
    }
    // Of an unknown type the period has more scatter, and is that of a concrete frame.
    let unknown = text("name,width,height,Floor,Storeys\na,0.5,2,3,5\nb,0.5,2,G,5\n")[0].place;
    let [walls, steel] = ["masonry", "steel"].map(|building| {
        let head = "name,width,height,Floor,Storeys,Building";
        text(&format!("{head}\na,0.5,2,3,5,{building}\nb,0.5,2,G,5,\n"))[0].place
    });
    assert!(unknown.period_sd.unwrap() > 0.3 && walls.period_sd.is_none());
    assert!((walls.period.unwrap() - 0.418).abs() < 1e-3 && (unknown.period.unwrap() - 0.612).abs() < 1e-3);
    let spread = 1.96 * unknown.period_sd.unwrap();
    for known in [walls, steel] {
        assert!((known.period.unwrap() / unknown.period.unwrap()).ln().abs() < spread);
    }
}

#[test]
fn the_ground_floor_is_asked_for_where_nothing_tells() {
    let list = "name,width,height,Floor,Storeys\na,0.5,2,1,5\nb,0.5,2,3,5\n";
    let asked = format!("{:?}", read(list, "", None).unwrap_err());
    assert!(asked.contains("floor is 1"), "{asked}");
    for (ground_floor, level) in [(1, 0.4), (0, 0.6)] {
        let objects = read(list, "", Some(ground_floor)).unwrap();
        assert!((objects[1].place.level.unwrap() - level).abs() < 1e-12);
    }
}

#[test]
fn what_is_not_understood_of_an_object_is_a_reason_for_no_answer() {
    for (list, named) in [
        ("name,width,height,Floor\na,0.5,2,3\nb,0.5,2,0\n", "Storeys"),
        ("name,width,height,Floor,Storeys\na,0.5,2,7,5\nb,0.5,2,0,5\n", "5 storeys"),
        ("name,width,height,Floor,Storeys\na,0.5,2,mezzanine,5\n", "mezzanine"),
        ("name,width,height,Floor,Storeys,Level\na,0.5,2,3,5,0.2\nb,0.5,2,0,5,0\n", "a level"),
        ("name,width,height,Floor,Storeys,Building\na,0.5,2,3,5,jelly\nb,0.5,2,0,5,\n", "jelly"),
        ("name,width,height,centre of mass (cm)\na,0.5,2,80\n", "centre of mass"),
        ("name,width,height,friction class\na,0.5,2,C2\n", "friction class"),
        ("name,width,height,Not anchored\na,0.5,2,x\n", "Not anchored"),
        ("name,width,height\nCabinet on castors,0.5,2\n", "castors"),
        ("name,width,height,Qty (pairs)\na,0.5,2,2\n", "Qty (pairs)"),
        ("name,width,height,Location\na,0.5,2,3rd floor east\nb,0.5,2,hall\n", "3rd floor east"),
        ("name,width,height\nStorey 3 - laboratories\na,0.5,2\n", "Storey 3"),
        ("name,width,height,Location\na,0.5,2,3F-201\nb,0.5,2,2/F\n", "3F-201"),
        ("name,width,height,Notes\na,0.5,2,bolted to slab\n", "bolted to slab"),
        ("name,width,height,Centre height\na,0.5,2,45%\n", "45%"),
        ("name,width,Ø,height\na,0.5,0.4,2\n", "diameter"),
        ("name,width,height\nA,0.5 m,2\nB,0.5,2\n", "0.5 m"),
        ("name,width,height\nrack,#N/A,2.0\nshelf,0.9,1.8\n", "#N/A"),
        ("Qty,width,height\n#N/A,0.4,1.9\n2,0.5,1.9\n#REF!,0.3,1.9\n", "#N/A"),
        ("name,width,height,Storey,Storeys\na,0.5,2,,5\nb,0.5,2,3,5\nc,0.5,2,G,5\n", "no floor"),
        ("name,width,height,level,T1\na,0.5,2,,\nb,0.5,2,0.6,0.5\n", "no floor"),
        ("name,width,height,elevation\na,0.5,2,12\n", "elevation"),
        ("name,width,height,Anchored\na,0.5,2,?\n", "'?'"),
        ("name,width,height,Anchored\na,0.5,2,No (bolts removed)\n", "yes or no"),
        ("name,width,height,Level,T1 (s)\na,0.5,2,60,0.6\n", "level is 60"),
        ("name,width,height,level (m)\na,0.5,2,3\n", "level is in m"),
        ("name,width,height,Secured\na,0.5,2,2 bolts M10\n", "not free to rock"),
        ("name,width,height,on wheels?\na,0.5,2,yes\n", "rolls"),
        ("name,width,height\na,60,190\n", "width is 60"),
        ("name,width,height,centre offset\na,0.5,2,0.25\n", "does not stand"),
        ("name,width (cm),height (cm),Centre height (cm)\na,50,200,1.1\n", "another unit"),
        ("name,width (cm),height (cm)\na,40 mm,200\nb,40,200\n", "line 2, column 'width (cm)': '40 mm'"),
        ("name,width (cm),height (cm)\na,~40,200\nb,40,200\n", "line 2, column 'width (cm)': '~40'"),
    ] {
        assert!(reason(list).contains(named), "{named}: {}", reason(list));
    }
    for list in [
        "name,width,height,Floor,Level,T1\na,0.5,2,3,0.6,0.5\n",
        "name,width,height,depth,COG height (m)\na,0.5,2,n/a,0.8\n",
        "name,width,height,Unit\na,0.5,2,Intensive care\n",
        "name,width,height,Secured,on wheels?\na,0.5,2,not bolted,no\nb,0.5,2,unsecured,n\n",
        "name,width,height,anchored\nA,0.5,1.9,not anchored\nB,0.5,1.9,un-anchored\n",
    ] {
        assert!(text(list).iter().all(|object| object.refused.is_none() && object.sides().is_ok()), "{list}");
    }
    let all = text("name,width,depth,height\na,5,5,19\nb,5,5,15\nc,0.05,,1.7\n");
    let warned = all.iter().map(|object| structure_warnings(&object.sides().unwrap()[0].structure));
    let size = vec![Warning::ImplausibleSize];
    assert_eq!(warned.collect::<Vec<_>>(), [size.clone(), vec![], size]);
    let thin = text("name,width (mm),height (m)\nA,1.8,0.1\nB,400,2\n");
    assert!(thin[0].shape.width == Some(0.0018) && thin[1].shape.width == Some(0.4), "no digits come");
    let rooms = text("name\twidth (mm)\tdepth (mm)\theight (mm)\na\t600\t1,000\t2,000\nb\t900\t400\t1,800\n");
    assert_eq!(rooms[0].shape.depth, Some(1.0));
}

#[test]
fn lengths_that_no_list_has_are_refused_with_what_is_meant() {
    for (list, named) in [
        ("name;width (mm);height (mm)\na;1.100;2.200\nb;0.850;1.900\n", "1.100"),
        ("name;width (mm);height (mm)\na;600;1.900\nb;850;2.100\n", "height (mm)"),
        ("name;width (mm);height (mm)\na;0.6;1.9\n", "in m"),
        ("name;width (cm);height (cm)\na;0.6;1.9\n", "in m"),
        ("name,width (in),width (cm),height (cm)\na,20,51,190\n", "'width (in)' and 'width (cm)'"),
        ("name,width,height\n", "rows"),
        ("Item,Building height (m),Object height (m)\na,17,2\n", "'Building height (m)'"),
        ("name,width,height\na,20,75\n* all dimensions in inches\n", "in inches"),
        ("name,width,height\n(mm),,\na,3,9\n", "mm"),
        ("name,width,height,cm\na,3,9,\n", "cm"),
        ("name,width,height,unit\na,9,30,in\nb,50,200,cm\n", "(in)"),
        ("Name;Breite;Höhe\nMaße in Zentimeter\nVase;3;9\n", "Zentimeter"),
        ("name,width,height,CoG (% of height)\na,0.5,2,30\n", "%"),
        ("name,Number,width,height\na,101,0.5,2\nb,105,0.5,2\n", "'Number'"),
    ] {
        let refusal = read(list, "", None).unwrap_err().to_string();
        assert!(refusal.contains(named), "{named}: {refusal}");
    }
    for list in [
        "All in (m)\nname,width,depth,height\na,0.6,0.9,1.9\n",
        ",Dimensions (mm),,\nname,width,depth,height\na,600,900,1900\n",
        ";Dimensions [cm];;\n;W;D;H\na;60;90;190\n",
        "name,Ø,height\na,0.6,1.9\n",
        "name,W × D × H (mm)\na,600x900x1900\n",
        "名称,幅㎝,高さ㎝\na,６０,190\n",
        "name,Width ″,Height ″\na,23.62204724,74.8\n",
        "name,width,height\na,60 cm,190 cm\n",
        "name,Overall width (centimetres),height (centimetres)\na,60,190\n",
    ] {
        assert!((text(list)[0].shape.width.unwrap() - 0.6).abs() < 1e-9, "{list}");
    }
}

#[test]
fn each_column_and_line_has_a_role() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    let told = |list: &str| {
        std::fs::write(&path, list).unwrap();
        let mut reader = Reader::default();
        let objects = objects::read(&path, &mut reader, &ListDefaults::default()).unwrap();
        (objects, reader.readings.remove(0), reader.warnings.lines())
    };
    let list = "No.,name,Room,Mass (kg),width,height,Value,Remarks\nRow A\n1,a,R1,80,0.5,2,100,old\n,Total,,80,,,,\n";
    let (objects, reading, _) = told(list);
    assert_eq!((objects.len(), reading.rows), (1, 1));
    assert_eq!(
        reading.gaps().unwrap(),
        "Not understood in list.csv: column 'Value'; the texts of column 'Remarks'."
    );
    assert_eq!(reading.others, ["line 2: section 'Row A'", "line 4: a row of totals"]);
    let labels: Vec<&str> = objects[0].labels.iter().map(|(_, cell)| cell.as_str()).collect();
    assert_eq!(labels, ["1", "R1", "old", "Row A"]);
    let (_, _, lines) = told("name,width,depth,height,eta\na,0.5,NA,2,\nb,0.5,1,2,null\n");
    assert!(lines.len() == 1 && lines[0].starts_with("depth of a, eta of b:"), "{lines:?}");
    let open = "name,Number,width,depth,height,anchored\na,1023,0.5,-,2,no\nb,1024,0.5,1,2,\n";
    let (objects, _, lines) = told(open);
    assert!(objects.iter().all(|object| object.count.is_none()), "a number of each row counts nothing");
    assert!(lines.join("\n").contains("depth of a, anchored of b"), "{lines:?}");
}

#[test]
fn each_word_unit_and_sign_of_a_heading_has_a_role() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    let words = include_str!("../../data/headings.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    for (about, word) in words.filter_map(|line| line.split_once(',')) {
        for heading in ["", " (mm)", " %", " class"].map(|end| format!("{word}{end}")) {
            for (cell, other) in [("7", "7"), ("yes", ""), ("blue", "green")] {
                std::fs::write(&path, format!("Thing,W,H,{heading}\nvase,.4,2,{cell}\nurn,.4,2,{other}\n"))
                    .unwrap();
                let mut reader = Reader::default();
                let Ok(objects) = objects::read(&path, &mut reader, &ListDefaults::default()) else {
                    continue;
                };
                let column = &reader.readings[0].columns[3];
                let is_label = objects[0].labels.contains(&(heading.clone(), cell.to_string()));
                assert_eq!(column.meaning == Meaning::Kept, is_label, "{heading}: {column:?}");
                assert_eq!(column.filled, 1 + usize::from(!other.is_empty()), "{heading}");
                let is_said = reader.readings[0].gaps().iter().any(|line| line.contains(&heading));
                let is_note = is_label && about == "remark" && heading.trim_end_matches(" %") == word;
                assert_eq!(column.meaning == Meaning::NotUnderstood || is_note, is_said, "{heading}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn all_lines_of_a_list_are_rows_or_told(kinds in collection::vec(0..8_usize, 1..30)) {
        const LINES: [&str; 8] = [
            "vase,1,.4,2,a", "urn,2,.5,1.9,b", "Room 2,,,,", "Total,3,,,", "name,qty,width,height,note", "",
            "# by hand", "* two rooms",
        ];
        let lines: Vec<&str> = kinds.iter().map(|kind| LINES[*kind]).collect();
        // A text with few commas is one of words between blanks.
        prop_assume!(2 * kinds.iter().filter(|kind| **kind < 5).count() >= kinds.len());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.csv");
        std::fs::write(&path, format!("name,qty,width,height,note\nfirst,1,.4,2,c\n{}\n", lines.join("\n"))).unwrap();
        let mut reader = Reader::default();
        let objects = objects::read(&path, &mut reader, &ListDefaults::default()).unwrap();
        let Reading { rows, others, .. } = reader.readings.remove(0);
        prop_assert_eq!(objects.len(), rows);
        prop_assert_eq!(rows + others.len(), 1 + lines.iter().filter(|line| !line.is_empty()).count());
        prop_assert_eq!(rows, 1 + kinds.iter().filter(|kind| **kind < 2).count());
    }
}

#[test]
fn a_hundred_thousand_rows_are_read() {
    // In quadratic time this test would not end.
    let rows: String = (0..100_000).map(|row| format!("rack {},0.5,2\n", row / 2)).collect();
    assert_eq!(text(&format!("name,width,height\n{rows}")).len(), 100_000);
}

#[test]
fn a_side_that_is_not_read_gives_no_answer() {
    assert!(reason("name,width (cm),depht (cm),height (cm)\nA,90,40,190\n").contains("depht"));
    assert!(text("name,width (cm),depth (cm),height (cm)\nA,,100,200\n")[0].shape.width.is_none());
    let sides = |object: &Object| (object.shape.width, object.shape.depth);
    let [breadth, length] = ["breadth (cm),length (cm)", "Breite (cm),Länge (cm)"]
        .map(|heads| sides(&text(&format!("name,{heads},height (cm)\nA,40,90,190\n"))[0]));
    assert_eq!(breadth, length);
    assert!((breadth.0.unwrap() - 0.4).abs() < 1e-12 && (breadth.1.unwrap() - 0.9).abs() < 1e-12);
}
