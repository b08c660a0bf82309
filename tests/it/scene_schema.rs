//! The vocabulary against the reader: every element, attribute and default; the schemas and docs/format.md against the
//! vocabulary; and all scenes against the schemas by `xmllint`, where it is there.

use std::path::{Path, PathBuf};
use std::process::Command;

use polyscene::scene::{
    Content, Document, ElementInfo, Need, Part, Scene, Since, VOCABULARY, ValueKind, schema,
};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A value that is not a default anywhere.
fn other_value(kind: ValueKind) -> String {
    match kind {
        ValueKind::Number | ValueKind::Positive | ValueKind::NotNegative => "0.75".into(),
        ValueKind::Between(low, high) => (0.5 * (low + high)).to_string(),
        ValueKind::Tiles | ValueKind::Id => "3".into(),
        ValueKind::Version => "1.1".into(),
        ValueKind::Text => "iron".into(),
    }
}

/// An element with only what it needs; `extra` goes inside.
fn least(info: &ElementInfo, extra: &str) -> String {
    let attributes = attributes(info, other_value);
    let inside: String = match info.content {
        Content::Parts(parts) => {
            let needed = parts.iter().filter(|part| part.need == Need::Required);
            let shape = parts.iter().find(|part| part.need == Need::Shape);
            needed.chain(shape).map(|part| least(&part.element, "")).collect()
        }
        Content::List(_) | Content::Anything => String::new(),
    };
    format!("<{name}{attributes}>{inside}{extra}</{name}>", name = info.name)
}

fn attributes(info: &ElementInfo, value: impl Fn(ValueKind) -> String) -> String {
    info.attributes.iter().map(|a| format!(" {}=\"{}\"", a.name, value(a.kind))).collect()
}

/// A document with `inner` in place of the element that `path` leads to.
fn document(path: &[&'static ElementInfo], inner: &str) -> Document {
    let mut text = inner.to_owned();
    for (depth, info) in path.iter().enumerate().rev() {
        if depth + 1 < path.len() {
            text = without(info, path[depth + 1], &text);
        }
    }
    Document::from_bytes(text.as_bytes())
}

/// The least parent with `inner` in place of one of its children.
fn without(parent: &ElementInfo, child: &ElementInfo, inner: &str) -> String {
    let attributes = attributes(parent, other_value);
    let mut inside = inner.to_owned();
    if let Content::Parts(parts) = parent.content {
        let is_shape = parts.iter().any(|p| p.element.name == child.name && p.need == Need::Shape);
        let others = parts.iter().filter(|part| part.element.name != child.name);
        let shape = parts.iter().find(|part| part.need == Need::Shape).filter(|_| !is_shape);
        let shape = shape.map(|part| part.element.name);
        for part in others.filter(|p| p.need == Need::Required || Some(p.element.name) == shape) {
            inside.push_str(&least(&part.element, ""));
        }
    }
    format!("<{name}{attributes}>{inside}</{name}>", name = parent.name)
}

/// Every element with the elements above it.
fn every(mut visit: impl FnMut(&[&'static ElementInfo])) {
    fn descend(path: &mut Vec<&'static ElementInfo>, visit: &mut impl FnMut(&[&'static ElementInfo])) {
        visit(path);
        let Some(last) = path.last().copied() else { return };
        for child in last.children() {
            path.push(child);
            descend(path, visit);
            path.pop();
        }
    }
    descend(&mut vec![&VOCABULARY], &mut visit);
}

fn unknown(document: &Document) -> Vec<String> {
    let said = document.diagnostics().iter().filter(|d| d.message.contains("is not known here"));
    said.map(ToString::to_string).collect()
}

fn part(path: &[&'static ElementInfo]) -> Option<&'static Part> {
    let [.., parent, last] = path else { return None };
    let Content::Parts(parts) = parent.content else { return None };
    parts.iter().find(|part| part.element.name == last.name)
}

fn name(path: &[&'static ElementInfo]) -> String {
    path.iter().map(|info| format!("/{}", info.name)).collect()
}

/// The scene, with what numbers its elements made alike.
fn meaning(document: &Document) -> Option<Scene> {
    let mut scene = document.scene().cloned()?;
    scene.bodies.iter_mut().for_each(|body| body.key = Default::default());
    scene.forces.iter_mut().for_each(|force| force.key = Default::default());
    Some(scene)
}

#[test]
fn the_reader_knows_every_element_and_attribute_and_no_others() {
    every(|path| {
        let info = path[path.len() - 1];
        let known = document(path, &least(info, ""));
        assert!(unknown(&known).is_empty(), "{}: {:?}", name(path), unknown(&known));
        assert_eq!(known.foreign(), Default::default(), "{}", name(path));
        if matches!(info.content, Content::Anything) {
            return;
        }
        let extended = least(info, "<Zebra />").replacen(
            &format!("<{}", info.name),
            &format!("<{} Zoo=\"1\"", info.name),
            1,
        );
        let document = document(path, &extended);
        assert_eq!(unknown(&document).len(), 2, "{}: {:?}", name(path), document.diagnostics());
        assert_eq!(document.foreign().unknown, ["Zoo", "Zebra"], "{}", name(path));
    });
}

#[test]
fn what_is_required_is_and_what_is_not_has_its_default() {
    every(|path| {
        let info = path[path.len() - 1];
        for attribute in info.attributes.iter().filter(|attribute| attribute.required) {
            let text = format!(" {}=\"{}\"", attribute.name, other_value(attribute.kind));
            let document = document(path, &least(info, "").replacen(&text, "", 1));
            let says = |d: &polyscene::scene::Diagnostic| {
                d.is_error() && d.message.contains(&format!("the attribute {} is missing", attribute.name))
            };
            assert!(document.diagnostics().iter().any(says), "{}: {:?}", name(path), document.diagnostics());
        }
        let Some(part) = part(path) else { return };
        let missing = document(path, "");
        match part.need {
            Need::Required => assert!(missing.has_errors(), "{} is needed", name(path)),
            // That of the other shape stands there instead.
            Need::Shape => {}
            Need::Optional => assert!(!missing.has_errors(), "{}: {:?}", name(path), missing.diagnostics()),
            Need::Default(value) => {
                let written = format!("<{}{} />", info.name, attributes(info, |_| value.to_owned()));
                let given = document(path, &written);
                assert_eq!(meaning(&missing), meaning(&given), "{}: default {value}", name(path));
                let other = document(path, &least(info, ""));
                let differs = meaning(&other) != meaning(&missing) || other.has_errors();
                assert!(differs, "{} says nothing", name(path));
            }
        }
    });
}

#[test]
fn elements_of_1_1_are_those_that_an_old_file_must_not_have() {
    every(|path| {
        let info = path[path.len() - 1];
        let is_new = path.iter().any(|info| info.since == Since::V1_1);
        let document = document(path, &least(info, ""));
        assert_eq!(!document.reasons_for_1_1().is_empty(), is_new, "{}", name(path));
    });
}

#[test]
fn the_schemas_are_those_of_the_vocabulary() {
    for (version, file) in versions() {
        let kept = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(kept == schema(version), "write {} anew by `polyscene schema`", file.display());
    }
}

fn versions() -> [(Since, PathBuf); 2] {
    let file = |number| root().join(format!("assets/polyphysics-{number}.xsd"));
    [(Since::V1_0, file("1.0")), (Since::V1_1, file("1.1"))]
}

/// Whether a scene fits a schema, and what was said; `None` without `xmllint`.
fn fits(schema: &Path, scene: &Path) -> Option<Result<(), String>> {
    let output = Command::new("xmllint").args(["--noout", "--schema"]).args([schema, scene]).output().ok()?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    Some(if output.status.success() { Ok(()) } else { Err(said) })
}

#[test]
fn all_scenes_fit_the_schemas_and_wrong_ones_do_not() {
    let [(_, old), (_, new)] = versions();
    for folder in ["scenes", "scenes/hard"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("a folder of scenes") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "xml") {
                continue;
            }
            let Some(fitting) = fits(&new, &path) else {
                println!("skipped: there is no xmllint");
                return;
            };
            assert_eq!(fitting, Ok(()), "{}", path.display());
            let is_old = Document::open(&path).reasons_for_1_1().is_empty();
            let says_1_1 = std::fs::read_to_string(&path).expect("a scene").contains("Version=\"1.1\"");
            assert_eq!(fits(&old, &path) == Some(Ok(())), is_old && !says_1_1, "{}", path.display());
        }
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.xml");
    let body = "<SoftObject UserID=\"1\"><Translation X=\"1,5\" Y=\".5\" Z=\"-3E-05\"/><Bounce F32=\"-0\"/><Sphere><Radius F32=\" 0,5\"/></Sphere></SoftObject>";
    let scene = format!(
        "<PolyPhysicsXml Version=\"1.0\"><Map><Size X=\"1\" Y=\"1\" Z=\"1\"/><Tiles X=\"65536\" Y=\"1\" Z=\"1,0\"/></Map><Primitives>{body}</Primitives></PolyPhysicsXml>"
    );
    let wrong = [
        ("Radius F32=\" 0,5\"", "Radius F32=\"0,0\""),
        ("Radius F32=\" 0,5\"", "Radius F32=\"0x5\""),
        ("X=\"1,5\"", "X=\"1.234,5\""),
        ("F32=\"-0\"", "F32=\"-0,1\""),
        ("65536", "65537"),
        ("<Sphere>", "<Sphere Zoo=\"1\">"),
        ("<Bounce F32=\"-0\"/>", "<Friction F32=\"0\"/>"),
        ("<Bounce F32=\"-0\"/>", "<Bounce F32=\"1\"/><Bounce F32=\"1\"/>"),
        ("<Translation X=\"1,5\" Y=\".5\" Z=\"-3E-05\"/>", ""),
        ("UserID=\"1\"", "UserID=\"one\""),
        ("Version=\"1.0\"", "Version=\"1.1\""),
    ];
    std::fs::write(&path, &scene).expect("a scene");
    assert_eq!(fits(&old, &path), Some(Ok(())));
    for (right, other) in wrong {
        assert!(scene.contains(right), "{right}");
        std::fs::write(&path, scene.replacen(right, other, 1)).expect("a scene");
        assert!(fits(&old, &path).is_some_and(|fits| fits.is_err()), "{other} fits");
    }
}

/// The list of docs/format.md, one line per element.
fn documented() -> String {
    let mut text = String::from("| element | holds | when missing | says |\n| --- | --- | --- | --- |\n");
    let mut listed: Vec<String> = Vec::new();
    every(|path| {
        let info = path[path.len() - 1];
        let attributes: Vec<_> = info.attributes.iter().map(|a| format!("`{}`", a.name)).collect();
        let holds = match info.content {
            Content::Anything => "…".to_owned(),
            _ if attributes.len() > 4 => "see [`params.rs`](../src/scene/params.rs)".to_owned(),
            _ => attributes.join(" "),
        };
        let missing = match part(path).map(|part| part.need) {
            Some(Need::Required) => "an error".to_owned(),
            Some(Need::Shape) => "one shape is needed".to_owned(),
            Some(Need::Default(value)) => value.to_owned(),
            Some(Need::Optional) | None => String::new(),
        };
        let new = if info.since == Since::V1_1 { " (1.1)" } else { "" };
        let parent = path.len().checked_sub(2).map_or(String::new(), |at| format!("{}/", path[at].name));
        let line = format!("| `{parent}{}`{new} | {holds} | {missing} | {} |\n", info.name, info.meaning);
        if !listed.contains(&line) {
            listed.push(line);
        }
    });
    text.extend(listed);
    text
}

#[test]
fn the_documentation_lists_the_vocabulary() {
    let page = std::fs::read_to_string(root().join("docs/format.md")).expect("docs/format.md");
    let wanted = documented();
    assert!(page.contains(&wanted), "docs/format.md should have\n{wanted}");
}
