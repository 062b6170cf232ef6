//! The setup sheet: its contents in each format. Texts of a job must not be executed in it.

use crate::support::folder::{Folder, err, out};
use crate::support::root;

fn sheet(folder: &Folder, more: &[&str]) -> String {
    let run = folder.run(&[&["sheet", "job.json", "--quiet"], more].concat());
    assert!(run.status.success(), "{more:?}: {}", err(&run));
    out(&run)
}

fn path(name: &str) -> String {
    root().join(name).to_string_lossy().into_owned()
}

#[test]
fn a_sheet_has_offsets_tools_operations_and_stops() {
    let folder = Folder::new("sheet");
    folder.write("job.json", std::fs::read(root().join("samples/bracket/job.json")).unwrap());
    let form = path("postforms/haas.pf");
    let json: serde_json::Value =
        serde_json::from_str(&sheet(&folder, &["--form", &form, "--format", "json"])).unwrap();
    assert_eq!(json["name"], "BRACKET");
    assert_eq!(json["program"], 1001);
    assert_eq!(json["works"][1]["name"], "G55");
    assert_eq!(json["works"][0]["cuts"][2], serde_json::json!([-0.8, 0.2]));
    assert_eq!(json["tools"].as_array().unwrap().len(), 5);
    assert_eq!(json["tools"][2]["lowest"], -0.8);
    assert_eq!(json["operations"][6]["name"], "dowels of the second part");
    assert_eq!(json["stops"], serde_json::json!([{"optional": true, "tool": 5.0, "comment": null}]));
    assert!(json["verdict"].as_str().unwrap().starts_with("equivalent"), "{json:#}");
    // the job, the form, postform.toml, and the program
    assert_eq!(json["hashes"].as_array().unwrap().len(), 4, "{}", json["hashes"]);
    let machine = path("samples/bracket/vf2.toml");
    let page = sheet(&folder, &["--form", &form, "--machine", &machine]);
    for part in
        ["<h1>BRACKET</h1>", "VF-2 north", "G55 X lies between", "<svg", "1/2 END MILL", "M1, if optional stop is on"]
    {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("src=") && !page.contains("href=") && !page.contains("<script"), "nothing from outside");
    let text = sheet(&folder, &["--form", &form, "--format", "md", "--only", "2"]);
    assert!(text.contains("| T2 |") && !text.contains("| T1 |"), "{text}");
}

/// The sheet contains the job's own fields of a tool and, with a machine, the time of each tool.
#[test]
fn a_sheet_has_what_a_job_says_of_tools_and_their_times() {
    let folder = Folder::new("sheet-data");
    let job = std::fs::read_to_string(root().join("samples/bracket/job.json")).unwrap();
    let data = r#""data": {"holder": "ER32", "stickout": 38}"#;
    folder.write("job.json", job.replacen("\"number\": 1,", &format!("\"number\": 1, {data},"), 1));
    let (form, machine) = (path("postforms/haas.pf"), path("samples/bracket/vf2.toml"));
    let text = sheet(&folder, &["--form", &form, "--format", "md"]);
    assert!(text.contains("1/2 END MILL, holder ER32, stickout 38 |"), "{text}");
    let more = ["--form", &form, "--format", "json", "--machine", &machine];
    let json: serde_json::Value = serde_json::from_str(&sheet(&folder, &more)).unwrap();
    assert_eq!(json["tools"][0]["data"], serde_json::json!({"holder": "ER32", "stickout": 38.0}));
    let seconds = |value: &serde_json::Value| value.as_f64().unwrap();
    let tools: f64 = json["tools"].as_array().unwrap().iter().map(|tool| seconds(&tool["seconds"])).sum();
    let whole = seconds(&json["times"]["whole"]);
    assert!((tools - whole).abs() < 1e-6 && whole > seconds(&json["minutes"]) * 60.0, "{json:#}");
}

/// The setup sheet of a lathe shows X as in the programs, and no Y. Its times include cuts at a constant surface speed.
#[test]
fn the_sheet_of_a_lathe_has_its_own_axes() {
    let folder = Folder::new("sheet-lathe");
    folder.write("job.json", std::fs::read(root().join("samples/lathe-part/job.json")).unwrap());
    let form = path("postforms/haas-lathe.pf");
    let json: serde_json::Value =
        serde_json::from_str(&sheet(&folder, &["--form", &form, "--format", "json"])).unwrap();
    assert_eq!(json["control"], "Haas lathe");
    assert_eq!(json["x"], "diameters");
    assert_eq!(json["works"][0]["cuts"], serde_json::json!([[0.0, 1.2], null, [-1.125, 0.2]]));
    assert_eq!(json["tools"][0]["length_register"], serde_json::Value::Null);
    // 400 ft/min at 0.008 inch per revolution: 1.1 inch at the radius 0.375, a quarter circle with the radius 0.125 at
    // its middle radius, and 0.1 inch at the radius 0.55
    let turns = |radius: f64| 400.0 * 12.0 / (std::f64::consts::TAU * radius);
    let quarter = std::f64::consts::FRAC_PI_2 * 0.125;
    let minutes = 1.1 / turns(0.375) + quarter / turns(0.4375) + 0.1 / turns(0.55);
    assert!((json["tools"][0]["minutes"].as_f64().unwrap() - minutes / 0.008).abs() < 1e-9, "{json:#}");
    let page = sheet(&folder, &["--form", &form]);
    assert!(page.contains("X counts diameters") && page.contains("Z to the right, X up"), "{page}");
    assert!(!page.contains("Y of cuts"), "a lathe has none");
}

/// Names and texts of a job are shown as text, whatever they contain.
#[test]
fn hostile_texts_are_text() {
    let folder = Folder::new("sheet-hostile");
    let name = "<script>alert(1)</script>|`x`";
    let job = r#"{"postform":1,"program":1,"name":"NAME","units":"mm","tools":[{"number":1,"name":"NAME","comment":"NAME"}],"operations":[{"name":"NAME","tool":1,"spindle":{"speed":900,"direction":"cw"},"feed":90,"path":[{"rapid":[0,0,9]},{"comment":"NAME"},{"stop":"program"},{"line":[0,0,-1]},{"rapid":[0,0,9]}]}]}"#;
    folder.write("job.json", job.replace("NAME", name));
    let form = path("postforms/linuxcnc.pf");
    let page = sheet(&folder, &["--form", &form]);
    assert!(!page.contains("<script") && page.contains("&lt;script&gt;"), "{page}");
    let text = sheet(&folder, &["--form", &form, "--format", "md"]);
    assert!(text.contains("\\<script\\>alert(1)\\</script\\>\\|\\`x\\`"), "{text}");
    // a stop is shown with the job's comment before it
    assert!(text.contains("| M0 | T1 | \\<script"), "{text}");
}

#[test]
fn what_a_sheet_cant_be_is_said() {
    let folder = Folder::new("sheet-wrong");
    folder.write("job.json", "{");
    let form = path("postforms/haas.pf");
    let run = |args: &[&str]| {
        let run = folder.run(args);
        (run.status.code(), err(&run))
    };
    assert!(run(&["sheet", "job.json", "--form", &form]).1.contains("PJ"));
    assert_eq!(run(&["sheet", "job.json", "--form", &form]).0, Some(1));
    let (code, said) = run(&["sheet", "job.json", "--form", &form, "-o", "a.pdf"]);
    assert!(code == Some(2) && said.contains(".html, .md or .json"), "{said}");
    let (code, said) = run(&["sheet", "job.json"]);
    assert!(code == Some(2) && said.contains("no form is given"), "{said}");
    let (code, _) = run(&["sheet", "job.json", "--form", &form, "-o", "job.json"]);
    assert!(code == Some(2) && folder.read("job.json") == "{", "an input stays");
}

/// The sheet has the hash of every file that was read, also of the machine in postform.toml, its tool table, and the
/// control. A pipe has no hash.
#[test]
fn a_sheet_has_the_hash_of_each_file_that_was_read() {
    let folder = Folder::new("sheet-hashes");
    folder.write("job.json", std::fs::read(root().join("samples/bracket/job.json")).unwrap());
    folder.write("haas.pf", std::fs::read(root().join("postforms/haas.pf")).unwrap());
    folder.write("m.toml", "name = \"M\"\n[tools]\nfile = \"tools.csv\"\n");
    folder.write("tools.csv", "number,length\n1,100\n");
    folder.write("postform.toml", "form = \"haas.pf\"\nmachine = \"m.toml\"\n");
    let json: serde_json::Value = serde_json::from_str(&sheet(&folder, &["--format", "json"])).unwrap();
    let hashes: Vec<[String; 2]> = serde_json::from_value(json["hashes"].clone()).unwrap();
    let names: Vec<&str> = hashes.iter().map(|[name, _]| name.rsplit('/').next().unwrap()).collect();
    assert_eq!(names, ["job.json", "haas.pf", "m.toml", "postform.toml", "tools.csv", "the program"]);
    // as `sha256sum` prints them
    assert_eq!(hashes[2][1], "87953cf5e78952cd9d2f8c3b46879ecac0ed43a3a22a3f49fddedfca62ec1910");
    assert_eq!(hashes[4][1], "3cba72185a6eb3270da44cee3a4b5e66a0b4b19c9e731089c72dba0fab47fb67");
}
