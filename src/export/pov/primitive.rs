//! Primitives and vectors in POV-Ray's language.

use glam::{DAffine3, DMat3, DVec3};

use crate::csg::{Primitive, QuadricCoefficients};

/// Returns the placed primitive without its closing brace.
///
/// It is written at about its size, and its matrix only turns it: POV-Ray applies its tolerances in the primitive's own
/// coordinates.
pub(super) fn body(primitive: &Primitive, scene_from_local: &DAffine3) -> String {
    let matrix3 = scene_from_local.matrix3;
    let columns = [matrix3.x_axis, matrix3.y_axis, matrix3.z_axis];
    let size = columns.map(DVec3::length).into_iter().fold(0.0, f64::max);
    let own = match primitive {
        Primitive::Sphere if matrix3 == DMat3::from_diagonal(DVec3::splat(matrix3.x_axis.x.abs())) => {
            return format!("sphere {{ {}, {:?}", vector(scene_from_local.translation), matrix3.x_axis.x);
        }
        Primitive::HalfSpace { normal, offset } => return plane(*normal, *offset, scene_from_local),
        Primitive::Quadric(q) => return quadric(q, scene_from_local),
        Primitive::Sphere => format!("sphere {{ 0, {size:?}"),
        Primitive::Cube => format!("box {{ -{size:?}, {size:?}"),
        Primitive::Cylinder => format!("cylinder {{ -y*{size:?}, y*{size:?}, {size:?}"),
        Primitive::Cone { bottom, top } => {
            format!("cone {{ -y*{size:?}, {:?}, y*{size:?}, {:?}", bottom * size, top * size)
        }
        // POV-Ray's default solver loses roots.
        Primitive::Torus { tube } => format!("torus {{ {size:?}, {:?} sturm", tube * size),
    };
    format!("{own} {}", matrix(&DAffine3 { matrix3: matrix3 * (1.0 / size), ..*scene_from_local }))
}

/// Returns a half-space in scene coordinates: POV-Ray computes wrong bounds for a composition if a matrix scales a
/// plane in it, and the composition disappears.
fn plane(normal: DVec3, offset: f64, scene_from_local: &DAffine3) -> String {
    let outward = (scene_from_local.matrix3.inverse().transpose() * normal).normalize();
    let point = scene_from_local.transform_point3(normal * offset);
    format!("plane {{ {}, {:?}", vector(outward), outward.dot(point))
}

/// Returns a quadric in scene coordinates. Its constant at the centre is at most 1: POV-Ray's bounds of hyperboloids
/// take it for 1.
fn quadric(q: &QuadricCoefficients, scene_from_local: &DAffine3) -> String {
    let [xy, yz, zx] = (q.products / 2.0).to_array();
    let local = DMat3::from_cols(
        DVec3::new(q.squares.x, xy, zx),
        DVec3::new(xy, q.squares.y, yz),
        DVec3::new(zx, yz, q.squares.z),
    );
    let DAffine3 { matrix3, translation } = scene_from_local.inverse();
    let square = matrix3.transpose() * local * matrix3;
    let linear = matrix3.transpose() * (local * translation * 2.0 + q.linear);
    let constant = translation.dot(local * translation) + q.linear.dot(translation) + q.constant;
    let squares = DVec3::new(square.x_axis.x, square.y_axis.y, square.z_axis.z);
    let from_centre = linear * linear / (4.0 * squares);
    let from_centre = DVec3::select(squares.cmpne(DVec3::ZERO), from_centre, DVec3::ZERO);
    let at_centre = constant - from_centre.element_sum();
    let coefficients = square.to_cols_array().into_iter().chain(linear.to_array());
    let greatest = coefficients.map(f64::abs).fold(at_centre.abs(), f64::max);
    format!(
        "quadric {{ {}, {}, {}, {:?}",
        vector(squares / greatest),
        // POV-Ray's order is xy, xz, yz.
        vector(2.0 * DVec3::new(square.x_axis.y, square.x_axis.z, square.y_axis.z) / greatest),
        vector(linear / greatest),
        constant / greatest
    )
}

fn matrix(map: &DAffine3) -> String {
    let numbers: Vec<_> = map.to_cols_array().iter().map(|number| format!("{number:?}")).collect();
    format!("matrix <{}>", numbers.join(", "))
}

/// Returns a vector. POV-Ray reads numbers such as `1e-20`, but not those of hundreds of digits.
pub(super) fn vector(v: DVec3) -> String {
    format!("<{:?}, {:?}, {:?}>", v.x, v.y, v.z)
}
