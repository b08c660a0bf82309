//! glTF 2.0 as one binary file: geometry, colours, names, cameras; what moves the bodies goes along as extras.

use glam::{DMat3, DVec3, Vec3};
use serde_json::{Map, Value, json};

use super::aspect::Aspect;
use super::axes::quaternion;
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::mesh::{self, Mesh};
use super::motion::Animation;
use super::names;
use super::range;
use super::report::{Fate, NO_FORCE_IDS, Report, approximated, dropped, kept, no_meaning, not_needed};
use crate::scene::{Body, ForceKind, Motion, Roughness, Shape, Viewpoint, rotation_matrix};

pub(super) const FORMAT: Format = Format {
    id: "gltf",
    name: "glTF 2.0, binary",
    extension: "glb",
    is_binary: true,
    moves: true,
    holds: "what is seen: geometry, colours, names, cameras, motion; physics as extras only",
    write,
};

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    range::seen(source, FORMAT.name)?;
    let mut file = File::default();
    let names = names::unique(source.scene, &[], str::to_owned);
    for (body, name) in source.scene.bodies.iter().zip(&names) {
        file.add_body(body, name);
    }
    if let Some(motion) = source.motion {
        file.add_animation(source, motion)?;
    }
    for viewpoint in source.document.viewpoints() {
        file.add_camera(&viewpoint, source.scene.map.size.length());
    }
    let bytes = binary(&file.json(source), &file.buffer)?;
    Ok(Exported { bytes, report: Report::of(source, fate) })
}

/// The lists of a glTF file.
#[derive(Default)]
struct File {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    cameras: Vec<Value>,
    animations: Vec<Value>,
    buffer: Vec<u8>,
    /// Shape, colour and where its mesh is.
    known: Vec<(Kind, Option<[u8; 3]>, usize)>,
    /// The accessors of each shape: points, normals, triangles.
    geometry: Vec<(Kind, [usize; 3])>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Sphere,
    Plate,
}

impl File {
    fn add_body(&mut self, body: &Body, name: &str) {
        let mut node = Map::new();
        node.insert("name".into(), json!(name));
        node.insert("translation".into(), json!(body.position.to_array()));
        let rotation = quaternion(rotation_matrix(body.rotation));
        node.insert("rotation".into(), json!(rotation.to_array()));
        let shape = match body.shape {
            Shape::Sphere { radius } => Some((Kind::Sphere, [radius; 3])),
            Shape::Plane { half_x, half_y } => Some((Kind::Plate, [half_x, half_y, 1.0])),
            Shape::Unbuilt { .. } => None,
        };
        if let Some((kind, scale)) = shape {
            node.insert("scale".into(), json!(scale));
            node.insert("mesh".into(), json!(self.mesh(kind, body.color)));
        }
        node.insert("extras".into(), extras(body));
        self.nodes.push(Value::Object(node));
    }

    /// One mesh for all bodies of a shape and colour.
    fn mesh(&mut self, kind: Kind, color: Option<[u8; 3]>) -> usize {
        if let Some((.., mesh)) = self.known.iter().find(|known| (known.0, known.1) == (kind, color)) {
            return *mesh;
        }
        let [points, normals, triangles] = self.geometry(kind);
        let material = self.materials.len();
        let mut surface = json!({ "metallicFactor": 0.0, "roughnessFactor": 0.6 });
        if let Some(color) = color {
            let [r, g, b] = color.map(linear);
            surface["baseColorFactor"] = json!([r, g, b, 1.0]);
        }
        // Plates are seen from both sides, as they are hit.
        self.materials.push(json!({ "pbrMetallicRoughness": surface, "doubleSided": kind == Kind::Plate }));
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": points, "NORMAL": normals },
            "indices": triangles,
            "material": material,
        }] }));
        self.known.push((kind, color, self.meshes.len() - 1));
        self.meshes.len() - 1
    }

    fn geometry(&mut self, kind: Kind) -> [usize; 3] {
        if let Some((_, accessors)) = self.geometry.iter().find(|known| known.0 == kind) {
            return *accessors;
        }
        let Mesh { points, normals, triangles } = match kind {
            Kind::Sphere => mesh::sphere(),
            Kind::Plate => mesh::square(),
        };
        let indices: Vec<u8> = triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect();
        let accessors = [
            self.vectors(&points),
            self.vectors(&normals),
            // Unsigned shorts for the element array.
            self.accessor(
                &indices,
                Some(34963),
                json!({ "componentType": 5123, "type": "SCALAR", "count": 3 * triangles.len() }),
            ),
        ];
        self.geometry.push((kind, accessors));
        accessors
    }

    /// Vectors of floats for the vertex array.
    fn vectors(&mut self, vectors: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        let all = vectors.iter().map(|vector| Vec3::from_array(*vector));
        let low = all.clone().fold(Vec3::INFINITY, Vec3::min).to_array();
        let high = all.fold(Vec3::NEG_INFINITY, Vec3::max).to_array();
        let about =
            json!({ "componentType": 5126, "type": "VEC3", "count": vectors.len(), "min": low, "max": high });
        self.accessor(&bytes, Some(34962), about)
    }

    /// `target` says which array of vertices it is for, if any.
    fn accessor(&mut self, bytes: &[u8], target: Option<u32>, mut about: Value) -> usize {
        let length = bytes.len();
        let mut view = json!({ "buffer": 0, "byteOffset": self.buffer.len(), "byteLength": length });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.buffer.extend(bytes);
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        about["bufferView"] = json!(self.views.len() - 1);
        self.accessors.push(about);
        self.accessors.len() - 1
    }

    /// Rising times of keys, s.
    fn times(&mut self, times: &[f32]) -> usize {
        let bytes: Vec<u8> = times.iter().flat_map(|time| time.to_le_bytes()).collect();
        let (first, last, count) = (times.first(), times.last(), times.len());
        let about =
            json!({ "componentType": 5126, "type": "SCALAR", "count": count, "min": [first], "max": [last] });
        self.accessor(&bytes, None, about)
    }

    /// A channel for the way of each moving body, and where bodies rub one for how it turns; the nodes of bodies come first,
    /// in their order.
    fn add_animation(&mut self, source: &Source<'_>, motion: &Animation) -> Result<(), ExportError> {
        let start = motion.frames.from;
        let shared = self.times(&motion.times.iter().map(|time| (time - start) as f32).collect::<Vec<_>>());
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for (node, body) in source.scene.bodies.iter().enumerate() {
            let Some(keys) = motion.keys(body.key) else { continue };
            let input = if motion.is_smooth(body.key) {
                shared
            } else {
                self.times(&keys.iter().map(|key| (key.time - start) as f32).collect::<Vec<_>>())
            };
            let places = keys.iter().flat_map(|key| key.position.as_vec3().to_array()).collect::<Vec<_>>();
            if let Some(key) = keys.iter().find(|key| !key.position.as_vec3().is_finite()) {
                return range::too_far(body, key.position, key.time, FORMAT.name);
            }
            let turns = keys.iter().filter_map(|key| key.orientation);
            let turns = turns.flat_map(|turn| turn.as_quat().normalize().to_array()).collect::<Vec<_>>();
            for (path, kind, numbers) in [("translation", "VEC3", places), ("rotation", "VEC4", turns)] {
                if numbers.is_empty() {
                    continue;
                }
                let bytes: Vec<u8> = numbers.into_iter().flat_map(f32::to_le_bytes).collect();
                let about = json!({ "componentType": 5126, "type": kind, "count": keys.len() });
                let output = self.accessor(&bytes, None, about);
                channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
                samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
            }
        }
        if !channels.is_empty() {
            self.animations.push(json!({ "name": "Motion", "samplers": samplers, "channels": channels }));
        }
        Ok(())
    }

    /// A camera looks along its −z, with y up. `extent` is what it must reach beyond its target.
    fn add_camera(&mut self, viewpoint: &Viewpoint, extent: f64) {
        let Viewpoint { name, perspective, target, yaw, pitch, height } = viewpoint;
        let height = if *height > 0.0 { *height } else { extent };
        let (sin_yaw, cos_yaw) = libm::sincos(*yaw);
        let (sin_pitch, cos_pitch) = libm::sincos(*pitch);
        let backward = DVec3::new(cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw);
        let right = DVec3::new(cos_yaw, 0.0, -sin_yaw);
        let distance = if *perspective { 0.5 * height / TAN_HALF_FOV } else { extent };
        let (near, far) = (1e-3 * distance, distance + extent);
        let camera = if *perspective {
            let angle = 2.0 * libm::atan(TAN_HALF_FOV);
            json!({ "type": "perspective", "perspective": { "yfov": angle, "znear": near, "zfar": far } })
        } else {
            let half = 0.5 * height;
            json!({ "type": "orthographic",
                    "orthographic": { "xmag": half, "ymag": half, "znear": near, "zfar": far } })
        };
        self.cameras.push(camera);
        let rotation = quaternion(DMat3::from_cols(right, backward.cross(right), backward));
        self.nodes.push(json!({
            "name": name,
            "camera": self.cameras.len() - 1,
            "translation": (*target + distance * backward).to_array(),
            "rotation": rotation.to_array(),
        }));
    }

    /// A list that is empty must not be there.
    fn json(&self, source: &Source<'_>) -> Value {
        let mut scene = json!({ "name": "PolyScene", "extras": scene_extras(source) });
        let generator = concat!("PolyScene ", env!("CARGO_PKG_VERSION"));
        let mut root = json!({ "asset": { "version": "2.0", "generator": generator }, "scene": 0 });
        if !self.nodes.is_empty() {
            scene["nodes"] = (0..self.nodes.len()).collect();
        }
        root["scenes"] = json!([scene]);
        let lists = [
            ("nodes", &self.nodes),
            ("meshes", &self.meshes),
            ("materials", &self.materials),
            ("accessors", &self.accessors),
            ("bufferViews", &self.views),
            ("cameras", &self.cameras),
            ("animations", &self.animations),
        ];
        for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
            root[name] = json!(list);
        }
        if !self.buffer.is_empty() {
            root["buffers"] = json!([{ "byteLength": self.buffer.len() }]);
        }
        root
    }
}

/// Of half the vertical angle of view, 20°, as this program's views have it.
const TAN_HALF_FOV: f64 = 0.363_970_234_266_202_4;

fn extras(body: &Body) -> Value {
    let mut extras = json!({ "UserID": body.id, "bounce": body.bounce });
    let Roughness { friction, rolling, tangential } = body.roughness;
    let rough = [("friction", friction), ("rolling_friction", rolling), ("tangential", tangential)];
    for (name, value) in rough.into_iter().filter(|(_, value)| *value != 0.0) {
        extras[name] = json!(value);
    }
    if body.spin != DVec3::ZERO {
        extras["angular_velocity_rad_per_s"] = json!(body.spin.to_array());
    }
    if let Motion::Dynamic { mass, velocity } = body.motion {
        extras["mass_kg"] = json!(mass);
        extras["velocity_m_per_s"] = json!(velocity.to_array());
    }
    for (name, text) in [("group", &body.group), ("material", &body.material)] {
        if let Some(text) = text {
            extras[name] = json!(text);
        }
    }
    if body.hidden {
        extras["hidden"] = json!(true);
    }
    extras
}

fn scene_extras(source: &Source<'_>) -> Value {
    let force = |kind: &ForceKind| match *kind {
        ForceKind::GravityPoint { position, intensity } => {
            json!({ "kind": "point gravity", "position_m": position.to_array(), "G_m3_per_s2": intensity })
        }
        ForceKind::GravityPlane { acceleration, .. } => {
            json!({ "kind": "uniform gravity", "acceleration_m_per_s2": acceleration.to_array() })
        }
        ForceKind::Drag { density } => json!({ "kind": "drag", "density_kg_per_m3": density }),
    };
    let forces: Vec<_> = source.scene.forces.iter().map(|one| force(&one.kind)).collect();
    json!({ "forces": forces, "map_size_m": source.scene.map.size.to_array() })
}

/// Colours of a scene are as a screen shows them (IEC 61966-2-1), factors are proportional to light.
fn linear(channel: u8) -> f64 {
    let share = f64::from(channel) / 255.0;
    let light = if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) };
    (light * 1e6).round() / 1e6
}

/// A header and two chunks, each filled up to four bytes.
fn binary(json: &Value, buffer: &[u8]) -> Result<Vec<u8>, ExportError> {
    let mut text = serde_json::to_vec(json)?;
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunks: &[(&[u8; 4], &[u8])] = &[(b"JSON", &text), (b"BIN\0", buffer)];
    let mut bytes = Vec::new();
    for (kind, data) in chunks.iter().filter(|(_, data)| !data.is_empty()) {
        bytes.extend(length(data.len())?);
        bytes.extend(*kind);
        bytes.extend(*data);
    }
    let header = [*b"glTF", 2_u32.to_le_bytes(), length(bytes.len() + 12)?].concat();
    Ok([header, bytes].concat())
}

fn length(bytes: usize) -> Result<[u8; 4], ExportError> {
    u32::try_from(bytes).map(u32::to_le_bytes).map_err(|_| ExportError::TooLarge)
}

fn fate(aspect: Aspect) -> Fate {
    let as_extras = || dropped("glTF is not physics; it is in `extras`, which only scripts read");
    match aspect {
        Aspect::Spheres => {
            approximated(format!("as triangles, inside the sphere by {} of its radius at most", mesh::SAG))
        }
        Aspect::Plates => kept("as squares seen from both sides"),
        Aspect::Unbuilt => dropped("nodes without a mesh are left"),
        Aspect::Masses
        | Aspect::Velocities
        | Aspect::Bounce
        | Aspect::Friction
        | Aspect::RollingFriction
        | Aspect::Tangential
        | Aspect::Spins
        | Aspect::UniformGravity
        | Aspect::PointGravity
        | Aspect::Drag => as_extras(),
        Aspect::Frictionless => dropped("glTF is not physics"),
        Aspect::UserIds => kept("in `extras`"),
        Aspect::ForceIds => not_needed(NO_FORCE_IDS),
        Aspect::BodyNames => kept("made unique where they repeat"),
        Aspect::Groups | Aspect::Materials => kept("in `extras`"),
        Aspect::Colors => kept("as the base colour, made linear"),
        Aspect::Hidden => approximated("they are seen; `extras` says that they were hidden"),
        Aspect::Locked => not_needed("protects bodies in this editor"),
        Aspect::ForceLooks => not_needed("says where this editor draws and lists a force"),
        Aspect::Map => not_needed("a search grid, on which no result depends; its size is in `extras`"),
        Aspect::TimeSpeed => dropped("an animation goes by model time"),
        Aspect::Solver => dropped("settings of this program's core"),
        Aspect::Viewpoints => kept("as cameras"),
        Aspect::Motion => approximated(
            "as an animation from 0 s on, along straight lines between the frames and the events of a body, by the shorter turn",
        ),
        Aspect::Comments | Aspect::Unknown => no_meaning(),
    }
}
