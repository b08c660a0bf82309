//! The typed scene: the meaning of a document, in SI units, right-handed, y up.

use compact_str::{CompactString, ToCompactString as _};
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// Identifies one element of a document for as long as the document and its edits live.
///
/// Keys are never reused, survive every edit and undo, and are not written to the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct NodeKey(pub u64);

/// The box `[0,x]×[0,y]×[0,z]` that the tiles divide. It does not collide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Metres, each > 0.
    pub size: DVec3,
    /// Tiles per axis, each 1..=65 536.
    pub tiles: [u32; 3],
}

impl Map {
    /// Whether a point, in m, lies in it or on its border.
    pub fn contains(&self, point: DVec3) -> bool {
        !(point.cmplt(DVec3::ZERO).any() || point.cmpgt(self.size).any())
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Force {
    pub key: NodeKey,
    /// UserID of the file; forces and bodies are separate name spaces and files repeat IDs.
    pub id: i64,
    /// Unique among forces: `id`, or `id#k` for the k-th (k ≥ 2) force of that id in file order.
    pub label: CompactString,
    pub name: Option<String>,
    /// The group it is listed in, such as `table` or `table/legs`; cosmetic.
    pub group: Option<String>,
    pub hidden: bool,
    pub locked: bool,
    pub kind: ForceKind,
}

impl Force {
    /// A force as scenes made by code have them: named by its UserID, which gives its key too, apart from those of bodies.
    pub fn new(id: i64, kind: ForceKind) -> Self {
        Self {
            key: NodeKey(1_000_000 + id.unsigned_abs()),
            id,
            label: id.to_compact_string(),
            name: None,
            group: None,
            hidden: false,
            locked: false,
            kind,
        }
    }

    /// What to call this force in front of a person: its name, or its label.
    pub fn display_name(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.label)
    }

    /// Whether a force before it in the file has the same UserID.
    pub fn repeats_id(&self) -> bool {
        self.label.contains('#')
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ForceKind {
    /// F = G m r/|r|³ towards `position`; `intensity` is G in m³/s², negative repels.
    GravityPoint { position: DVec3, intensity: f64 },
    /// F = m g; `acceleration` in m/s²; `position` says only where to draw it.
    GravityPlane { position: DVec3, acceleration: DVec3 },
    /// `SpaceAverse`: F = −½ C ρ S |v| v with C = 0.5 and S = πr²; `density` is ρ in kg/m³.
    Drag { density: f64 },
}

impl ForceKind {
    /// Where it is drawn, picked and dragged; drag is everywhere and nowhere.
    pub fn position(&self) -> Option<DVec3> {
        match *self {
            Self::GravityPoint { position, .. } | Self::GravityPlane { position, .. } => Some(position),
            Self::Drag { .. } => None,
        }
    }

    /// The same force elsewhere; `None` where it has no place.
    pub fn at(self, position: DVec3) -> Option<Self> {
        match self {
            Self::GravityPoint { intensity, .. } => Some(Self::GravityPoint { position, intensity }),
            Self::GravityPlane { acceleration, .. } => Some(Self::GravityPlane { position, acceleration }),
            Self::Drag { .. } => None,
        }
    }

    /// The same force moved; `None` where it has no place.
    pub fn moved(self, by: DVec3) -> Option<Self> {
        self.at(self.position()? + by)
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    pub key: NodeKey,
    /// UserID of the file, which may repeat.
    pub id: i64,
    /// Unique among bodies: `id`, or `id#k` for the k-th (k ≥ 2) body of that id in file order.
    pub label: CompactString,
    pub name: Option<String>,
    /// The group it is listed in, such as `table` or `table/legs`; cosmetic.
    pub group: Option<String>,
    /// sRGB; `None` lets the viewer choose.
    pub color: Option<[u8; 3]>,
    pub hidden: bool,
    pub locked: bool,
    /// Centre, metres.
    pub position: DVec3,
    /// Euler angles (α, β, γ) in radians; see [`rotation_matrix`].
    pub rotation: DVec3,
    /// Coefficient of restitution; a pair uses the product of both.
    pub bounce: f64,
    /// What resists sliding and rolling on other bodies.
    pub roughness: Roughness,
    /// Angular velocity at the start, rad/s, in the axes of the map; zero for a static body.
    pub spin: DVec3,
    /// A name that custom forces may look at.
    pub material: Option<String>,
    pub motion: Motion,
    pub shape: Shape,
}

impl Body {
    /// A body as scenes made by code have them: named by its UserID, which is its key too, Bounce 1, smooth, not turned, and
    /// without a colour or a material. Give the rest by `Body { bounce: 0.5, ..Body::new(…) }`.
    pub fn new(id: i64, position: DVec3, motion: Motion, shape: Shape) -> Self {
        Self {
            key: NodeKey(id.unsigned_abs()),
            id,
            label: id.to_compact_string(),
            name: None,
            group: None,
            color: None,
            hidden: false,
            locked: false,
            position,
            rotation: DVec3::ZERO,
            bounce: 1.0,
            roughness: Roughness::default(),
            spin: DVec3::ZERO,
            material: None,
            motion,
            shape,
        }
    }

    pub fn is_dynamic(&self) -> bool {
        matches!(self.motion, Motion::Dynamic { .. })
    }

    /// What to call this body in front of a person: its name, or its label.
    pub fn display_name(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.label)
    }

    /// Whether a body before it in the file has the same UserID.
    pub fn repeats_id(&self) -> bool {
        self.label.contains('#')
    }
}

/// What resists sliding and rolling on a body. A pair uses the geometric mean of both numbers, so a smooth body meets
/// all others without friction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Roughness {
    /// Coefficient μ of Coulomb's friction, ≥ 0.
    pub friction: f64,
    /// Share of the load that slows a rolling body, ≥ 0.
    pub rolling: f64,
    /// What part of the slip of an impact without sliding comes back, 0 to 1: the coefficient β₀ of Walton's law.
    pub tangential: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Motion {
    /// `HardObject`: never moves.
    Static,
    /// `SoftObject`: moved by forces and collisions. Mass in kg (> 0), start velocity in m/s.
    Dynamic { mass: f64, velocity: DVec3 },
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// Radius in metres, > 0.
    Sphere { radius: f64 },
    /// A bounded plane: ±`half_x` by ±`half_y` metres in its local xy plane, normal local +z,
    /// hit from both sides. Static bodies only.
    Plane { half_x: f64, half_y: f64 },
    /// A shape (or property) the format knows but this version cannot simulate. It is kept on save
    /// and is an error on run. Holds the element's name.
    Unbuilt { element: String },
}

/// The rotation of a body: R = Rx(α)·Ry(β)·Rz(γ), world from local.
pub fn rotation_matrix(euler: DVec3) -> DMat3 {
    DMat3::from_rotation_x(euler.x) * DMat3::from_rotation_y(euler.y) * DMat3::from_rotation_z(euler.z)
}
