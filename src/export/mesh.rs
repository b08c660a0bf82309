//! Triangles for shapes that are curves elsewhere: a sphere of radius 1 and a square of ±1.

use std::f64::consts::PI;

/// Points on the unit sphere or in the xy plane, their normals, and three indices per triangle, seen from outside
/// counter-clockwise.
pub(super) struct Mesh {
    pub points: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub triangles: Vec<[u16; 3]>,
}

/// Around the equator; half as many from pole to pole.
const SEGMENTS: u16 = 48;
const RINGS: u16 = SEGMENTS / 2;

/// How far the triangles are inside the sphere at most, in radii: 1 − cos²(π/48), for the middle of a square of two.
pub(super) const SAG: f64 = 0.0043;

/// The poles are single points, so that no triangle is degenerate.
pub(super) fn sphere() -> Mesh {
    let mut points = vec![[0.0, 1.0, 0.0]];
    for (ring, segment) in (1..RINGS).flat_map(|ring| (0..SEGMENTS).map(move |segment| (ring, segment))) {
        let (sin, cos) = libm::sincos(PI * f64::from(ring) / f64::from(RINGS));
        let (sin_around, cos_around) = libm::sincos(2.0 * PI * f64::from(segment) / f64::from(SEGMENTS));
        points.push([sin * sin_around, cos, sin * cos_around].map(|v| v as f32));
    }
    points.push([0.0, -1.0, 0.0]);
    let at = |ring: u16, segment: u16| 1 + (ring - 1) * SEGMENTS + segment % SEGMENTS;
    let last = 1 + (RINGS - 1) * SEGMENTS;
    let mut triangles = Vec::new();
    for segment in 0..SEGMENTS {
        triangles.push([0, at(1, segment), at(1, segment + 1)]);
        for ring in 1..RINGS - 1 {
            let [a, b] = [at(ring, segment), at(ring, segment + 1)];
            let [c, d] = [at(ring + 1, segment), at(ring + 1, segment + 1)];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
        triangles.push([last, at(RINGS - 1, segment + 1), at(RINGS - 1, segment)]);
    }
    Mesh { normals: points.clone(), points, triangles }
}

pub(super) fn square() -> Mesh {
    let points = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    Mesh { normals: vec![[0.0, 0.0, 1.0]; 4], points, triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_look_outwards_and_are_near_the_sphere() {
        let mesh = sphere();
        for triangle in &mesh.triangles {
            let [a, b, c] =
                triangle.map(|at| glam::Vec3::from_array(mesh.points[usize::from(at)]).as_dvec3());
            let normal = (b - a).cross(c - a);
            assert!(normal.length() > 1e-6 && normal.dot(a + b + c) > 0.0, "{triangle:?}");
            assert!(normal.normalize().dot(a) > 1.0 - SAG, "{triangle:?}");
        }
        assert_eq!(mesh.points.len() + mesh.triangles.len() / 2, 2 + 2 * (mesh.points.len() - 2) / 2 * 2);
    }
}
