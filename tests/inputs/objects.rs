//! Lists of objects in the forms that people keep them in.

use rockfrag::inputs::objects::{self, ListDefaults};
use rockfrag::inputs::{InputError, Rename, Renames};
use rockfrag_core::object::{Object, structure_warnings};
use rockfrag_core::warning::Warning;

use super::packed::{Cells, csv, ods, utf_16, xlsx};

/// Fifteen objects of a building with five storeys: name, number, width, depth and height (cm), anchors, and
/// the storey above the ground.
const LIST: [[&str; 7]; 15] = [
    ["Bookcase", "3", "30", "90", "200", "no", "0"],
    ["Server rack", "2", "60", "100", "210", "no", "1"],
    ["Shelf", "12", "40", "92.5", "180", "no", "2"],
    ["Autoclave", "1", "80", "80", "170", "yes", "2"],
    ["Drug cabinet", "4", "45", "60", "190", "no", "3"],
    ["Vase", "1", "25", "25", "80", "no", "3"],
    ["Statue", "1", "45", "40", "170", "no", "0"],
    ["Display case", "2", "50", "50", "190", "no", "0"],
    ["Locker", "6", "50", "40", "185", "no", "4"],
    ["Freezer", "1", "70", "75", "195", "no", "1"],
    ["Filing cabinet", "8", "41.5", "62", "132", "no", "4"],
    ["#2 rack", "1", "60", "80", "200", "no", "5"],
    ["Vending machine", "1", "90", "80", "183", "no", "0"],
    ["Copier", "1", "62", "70", "120", "no", "2"],
    ["Tower", "1", "0.5e2", "50", "1.05e2", "no", "3"],
];

fn with_heading<'a>(heading: &[&'a str], rows: Vec<Vec<&'a str>>) -> Vec<Vec<&'a str>> {
    [vec![heading.to_vec()], rows].concat()
}

fn read(
    name: &str,
    bytes: &[u8],
    columns: &str,
    ground_floor: Option<u32>,
) -> Result<Vec<Object>, InputError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    let renames: Vec<Rename> = columns.split_terminator(',').map(|text| text.parse().unwrap()).collect();
    let mut renames = Renames::new(&renames);
    let defaults = ListDefaults { ground_floor, ..ListDefaults::default() };
    let (objects, _) = objects::read(&path, &mut renames, &defaults)?;
    renames.expect_used()?;
    Ok(objects)
}

fn text(text: &str) -> Vec<Object> {
    read("list.csv", text.as_bytes(), "", None).unwrap_or_else(|why| panic!("{why}"))
}

/// Why the only object of a list has no answer.
fn reason(text: &str) -> String {
    let objects = read("list.csv", text.as_bytes(), "", None).unwrap_or_else(|why| panic!("{why}: {text}"));
    objects[0].sides().err().map_or(String::new(), |reason| reason.to_string())
}

#[test]
fn fifteen_objects_are_the_same_in_every_form() {
    let english: Vec<&str> =
        "Equipment,Qty,Width (cm),Depth (cm),Height (cm),Anchored,Storey,Storeys,Building"
            .split(',')
            .collect();
    let rows: Vec<Vec<&str>> = LIST.iter().map(|row| [&row[..], &["5", "concrete frame"]].concat()).collect();
    let cells = with_heading(&english, rows.clone());
    let plain = csv(&cells, ",");
    let expected = text(&plain);
    assert_eq!(expected.len(), 15);
    assert_eq!(expected[4].floor.as_deref(), Some("floor 3 of 5"));
    // Storey 3 of 5: 17.5 m high, T1 = .0466 H^.9.
    let place = expected[4].place;
    assert!(
        (place.level.unwrap() - 0.6).abs() < 1e-12
            && (place.period.unwrap() - 0.0466 * 17.5_f64.powf(0.9)).abs() < 1e-12
    );
    assert!(
        expected[3].refused.is_some()
            && expected.iter().filter(|object| object.refused.is_none()).count() == 14
    );

    let headings =
        "Bezeichnung;Anzahl;Breite (cm);Tiefe (cm);Höhe (cm);Verankert;Geschoss;Geschosse;Bauweise\n";
    let german = csv(&rows, ";").replace('.', ",").replace(";no;", ";nein;");
    let german = headings.to_string() + &german.replace("concrete frame", "Stahlbeton");

    let levels: Vec<String> =
        LIST.iter().map(|row| (row[6].parse::<f64>().unwrap() / 5.0).to_string()).collect();
    let period = place.period.unwrap().to_string();
    let with_levels = LIST.iter().zip(&levels).map(|(row, level)| {
        let period = if row[6] == "0" { "" } else { &period };
        [&row[..6], &[level.as_str(), period]].concat()
    });
    let with_levels = with_heading(
        &["Item", "Quantity", "W (cm)", "D (cm)", "H (cm)", "Anchors", "Level", "T1 (s)"],
        with_levels.collect(),
    );
    let as_cells: Cells = &cells;
    for (name, bytes) in [
        ("german.csv", german.clone().into_bytes()),
        ("latin.csv", german.chars().map(|sign| sign as u8).collect()),
        ("list.xlsx", xlsx(&[("Inventory", as_cells)])),
        ("list.ods", ods(as_cells)),
        ("utf16.txt", utf_16(&csv(&cells, "\t"), true, false)),
        ("cr.csv", plain.replace('\n', "\r").into_bytes()),
        ("levels.csv", csv(&with_levels, ",").into_bytes()),
    ] {
        let found = read(name, &bytes, "", None).unwrap_or_else(|why| panic!("{name}: {why}"));
        for (found, expected) in found.iter().zip(&expected) {
            let mut found = found.clone();
            // A period in a file has 15 digits.
            let period = found.place.period.zip(expected.place.period);
            if period.is_some_and(|(found, expected)| (found / expected - 1.0).abs() < 1e-12) {
                found.place.period = expected.place.period;
            }
            if name == "levels.csv" {
                found.floor.clone_from(&expected.floor);
            }
            // What is not free has a reason in the words of its list.
            found.refused = found.refused.and(expected.refused.clone());
            assert_eq!(&found, expected, "{name}");
        }
        assert_eq!(found.len(), expected.len(), "{name}");
    }
    let renamed = plain.replacen("Width (cm)", "Breadth (cm)", 1);
    assert_eq!(read("l.csv", renamed.as_bytes(), "width=Breadth (cm)", None), Ok(expected));
    assert!(matches!(
        read("l.csv", plain.as_bytes(), "width=Breadth (cm)", None),
        Err(InputError::Renamed { .. })
    ));
}

#[test]
fn floors_are_read_as_people_write_them() {
    let level = |floor: &str| {
        let list = format!("name,width,height,Floor,Storeys\na,0.5,2,{floor},5\nb,0.5,2,G,5\n");
        let object = &text(&list)[0];
        assert!(object.refused.is_none(), "{floor}: {:?}", object.refused);
        object.place.level
    };
    for ground in ["G", "EG", "GF", "0", "B1", "-1", "UG", "Erdgeschoss", "ground floor", "RDC", "地下1階"]
    {
        assert_eq!(level(ground), Some(0.0), "{ground}");
    }
    for third in ["3", "3rd", "3rd floor", "3. OG", "3.OG", "3F", "3階", "Level 3", "piano 3", "3e étage"] {
        assert_eq!(level(third), Some(0.6), "{third}");
    }
    assert_eq!(level("roof"), Some(1.0));
    // Of an unknown type the period has more scatter, and is that of a concrete frame.
    let unknown = text("name,width,height,Floor,Storeys\na,0.5,2,3,5\nb,0.5,2,G,5\n")[0].place;
    let walls =
        text("name,width,height,Floor,Storeys,Building\na,0.5,2,3,5,masonry\nb,0.5,2,G,5,\n")[0].place;
    assert!(unknown.period_sd.unwrap() > 0.3 && walls.period_sd.is_none());
    assert!((walls.period.unwrap() - 0.418).abs() < 1e-3 && (unknown.period.unwrap() - 0.612).abs() < 1e-3);
    let steel = text("name,width,height,Floor,Storeys,Building\na,0.5,2,3,5,steel\nb,0.5,2,G,5,\n")[0].place;
    let spread = 1.96 * unknown.period_sd.unwrap();
    for known in [walls, steel] {
        assert!((known.period.unwrap() / unknown.period.unwrap()).ln().abs() < spread);
    }
}

#[test]
fn the_ground_floor_is_asked_for_where_nothing_tells() {
    let list = "name,width,height,Floor,Storeys\na,0.5,2,1,5\nb,0.5,2,3,5\n";
    let asked = read("list.csv", list.as_bytes(), "", None).unwrap_err();
    assert!(
        matches!(asked, InputError::File { error, .. } if matches!(*error, InputError::GroundFloor { lowest: 1, .. }))
    );
    for (ground_floor, level) in [(1, 0.4), (0, 0.6)] {
        let objects = read("list.csv", list.as_bytes(), "", Some(ground_floor)).unwrap();
        assert!((objects[1].place.level.unwrap() - level).abs() < 1e-12);
    }
}

#[test]
fn what_is_not_understood_of_an_object_is_a_reason_for_no_answer() {
    for (list, named) in [
        ("name,width,height,Floor\na,0.5,2,3\nb,0.5,2,0\n", "Storeys"),
        ("name,width,height,Floor,Storeys\na,0.5,2,7,5\nb,0.5,2,0,5\n", "5 storeys"),
        ("name,width,height,Floor,Storeys\na,0.5,2,mezzanine,5\n", "mezzanine"),
        ("name,width,height,Floor,Storeys,Building\na,0.5,2,3,5,jelly\nb,0.5,2,0,5,\n", "jelly"),
        ("name,width,height,centre of mass (cm)\na,0.5,2,80\n", "centre of mass"),
        ("name,width,height,friction class\na,0.5,2,C2\n", "friction class"),
        ("name,width,height\nA,0.5 m,2\nB,0.5,2\n", "0.5 m"),
        ("name,width,height\nrack,#N/A,2.0\nshelf,0.9,1.8\n", "#N/A"),
        ("name,width,height\nA,1e400,2\nB,0.5,2\n", "1e400"),
        ("name,width,height\nTotal,0.5,2\nB,0.5,2\n", "totals"),
        ("name,width,height,Storey,Storeys\na,0.5,2,,5\nb,0.5,2,3,5\nc,0.5,2,G,5\n", "no floor"),
        ("name,width,height,Floor\na,0.5,2,-\nb,0.5,2,G\n", "no floor"),
        ("name,width,height,level,T1\na,0.5,2,,\nb,0.5,2,0.6,0.5\n", "no floor"),
        ("name,width,height,elevation\na,0.5,2,12\n", "elevation"),
        ("name,width,height,unit\na,500,2000,cubit\nb,500,2000,mm\n", "cubit"),
        ("name,width (cm),height,unit\na,500,2000,mm\n", "width (cm)"),
        ("name,width,height,Anchored\na,0.5,2,?\n", "'?'"),
        ("name,width,height,Anchored\na,0.5,2,tbc\n", "'tbc'"),
        ("name,width,height,Anchored\na,0.5,2,unknown\n", "'unknown'"),
        ("name,width,height,on wheels?\na,0.5,2,maybe\n", "'maybe'"),
        ("name,width,height,Anchored\na,0.5,2,No (bolts removed)\n", "yes or no"),
        ("name,width,height,Level,T1 (s)\na,0.5,2,1,0.6\nb,0.5,2,2,0.6\nc,0.5,2,0,0.6\n", "floor 1"),
        ("name,width,height,Level,T1 (s)\na,0.5,2,60,0.6\n", "level is 60"),
        ("name,width,height,Secured\na,0.5,2,2 bolts M10\n", "not free to rock"),
        ("name,width,height,Secured\na,0.5,2,x\n", "not free to rock"),
        ("name,width,height,on wheels?\na,0.5,2,yes\n", "rolls"),
        ("name,width,height\na,60,190\n", "width is 60"),
        ("name,width,height\na,20,101\n", "height is 101"),
        ("name,width,height,centre offset\na,0.5,2,0.25\n", "does not stand"),
        ("name,width (cm),height (cm),Centre height (cm)\na,50,200,1.1\n", "another unit"),
        ("name,width (cm),height (cm)\na,40 mm,200\nb,40,200\n", "line 2, column 'width (cm)': '40 mm'"),
        ("name,width (cm),height (cm)\na,~40,200\nb,40,200\n", "line 2, column 'width (cm)': '~40'"),
    ] {
        assert!(reason(list).contains(named), "{named}: {}", reason(list));
    }
    assert_eq!(reason("name,width,height,Floor,Level,T1\na,0.5,2,3,0.6,0.5\n"), "");
    assert_eq!(reason("name,width,height,depth,COG height (m)\na,0.5,2,n/a,0.8\n"), "");
    let tall = text("name,width,depth,height\na,5,5,19\nb,5,5,15\n");
    let warnings = tall.iter().map(|object| structure_warnings(&object.sides().unwrap()[0].structure));
    assert_eq!(warnings.collect::<Vec<_>>(), [vec![Warning::ImplausibleSize], vec![]]);
    let pole = text("name,width,height\na,0.05,1.7\n");
    assert_eq!(structure_warnings(&pole[0].sides().unwrap()[0].structure), [Warning::ImplausibleSize]);
    let free = "name,width,height,Secured,on wheels?\na,0.5,2,not bolted,no\nb,0.5,2,unsecured,n\n";
    assert!(text(free).iter().all(|object| object.refused.is_none()));
    assert!(reason("name,width,height,Unit\na,0.5,2,Intensive care\n").is_empty());
    let rows = text("name,width,height,unit\na,500,2000,mm\nb,50,200,cm\nc,0.5,2,m\n");
    assert!(rows.iter().all(|object| (object.shape.width, object.shape.height) == (Some(0.5), Some(2.0))));
    let rooms =
        text("name\twidth (mm)\tdepth (mm)\theight (mm)\nrack\t600\t1,000\t2,000\nshelf\t900\t400\t1,800\n");
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
        ("Item,Building height (m),Object height (m)\na,17,2\n", "'Building height (m)'"),
        (",Dimensions (mm),,\nname,width,depth,height\na,600,900,1900\n", "Dimensions (mm)"),
        (";Dimensions [cm];;\nname;width;depth;height\na;60;90;190\n", "Dimensions [cm]"),
    ] {
        let refusal = read("list.csv", list.as_bytes(), "", None).unwrap_err().to_string();
        assert!(refusal.contains(named), "{named}: {refusal}");
    }
    assert_eq!(text("All in (m)\nname,width,height\na,0.6,1.9\n")[0].shape.width, Some(0.6));
}

#[test]
fn columns_that_are_not_used_are_all_named_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(&path, "No.,name,Room,Mass (kg),width,height,Value,Remarks\n1,a,R1,80,0.5,2,100,old\n")
        .unwrap();
    let (_, warnings) = objects::read(&path, &mut Renames::new(&[]), &ListDefaults::default()).unwrap();
    let lines = warnings.lines();
    assert!(
        lines.len() == 1
            && ["No.", "Room", "Mass (kg)", "Value", "Remarks"].iter().all(|name| lines[0].contains(name))
    );
    let missing = "name,width,depth,height,eta\na,0.5,NA,2,\nb,0.5,1,2,null\n";
    std::fs::write(&path, missing).unwrap();
    let (_, warnings) = objects::read(&path, &mut Renames::new(&[]), &ListDefaults::default()).unwrap();
    let lines = warnings.lines();
    assert!(lines.len() == 1 && lines[0].starts_with("depth of a, eta of b:"), "{lines:?}");
    let open = "name,Number,width,depth,height,anchored\na,1023,0.5,-,2,no\nb,1024,0.5,1,2,\n";
    std::fs::write(&path, open).unwrap();
    let (objects, warnings) = objects::read(&path, &mut Renames::new(&[]), &ListDefaults::default()).unwrap();
    let lines = warnings.lines().join("\n");
    assert!(objects.iter().all(|object| object.count.is_none()), "a number of each row counts nothing");
    assert!(["depth of a, anchored of b", "Number"].iter().all(|about| lines.contains(about)), "{lines}");
}

#[test]
fn a_hundred_thousand_rows_take_linear_time() {
    let list = |rows: usize| {
        let rows: String = (0..rows).map(|row| format!("rack {},0.5,2\n", row / 2)).collect();
        format!("name,width,height\n{rows}")
    };
    let seconds = |rows: usize| {
        let list = list(rows);
        let start = std::time::Instant::now();
        assert_eq!(text(&list).len(), rows);
        start.elapsed().as_secs_f64()
    };
    // Quadratic time would be a hundred times as long.
    let (few, many) = (seconds(10_000), seconds(100_000));
    assert!(many < 40.0 * few.max(0.01), "{few} s, {many} s");
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
    let free = text("name,width,height,anchored\nA,0.5,1.9,not anchored\nB,0.5,1.9,un-anchored\n");
    assert!(free.iter().all(|object| object.refused.is_none()), "{free:?}");
}
