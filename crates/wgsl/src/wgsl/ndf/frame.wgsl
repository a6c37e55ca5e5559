// Orthonormal tangent frames, by the minimal rotation from (0, 0, 1):
// `asperity_ndf_sampling::Frame`.

struct Frame {
    tangent: vec3<f32>,
    bitangent: vec3<f32>,
    normal: vec3<f32>,
}

fn frame_product(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// v over its length, unchanged if the length is 1 up to rounding; zero if v has no direction.
fn frame_direction(v: vec3<f32>) -> vec3<f32> {
    let square = frame_product(v, v);
    if abs(square - 1.0) < 2.3841858e-7 {
        return v;
    }
    if !(square > ELEMENTARY_LEAST_NORMAL && square <= ELEMENTARY_LARGEST) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    return v / sqrt(square);
}

// The frame of the direction n, from the minimal rotation that takes (0, 0, 1) to n.
fn frame_of_direction(n: vec3<f32>) -> Frame {
    var a = 0.0;
    if n.z >= 0.0 {
        a = 1.0 / (1.0 + n.z);
    } else {
        let square = n.x * n.x + n.y * n.y;
        if square < 1e-30 {
            return Frame(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, -1.0, 0.0), n);
        }
        a = (1.0 - n.z) / square;
    }
    let both = -n.x * n.y * a;
    return Frame(vec3<f32>(1.0 - n.x * n.x * a, both, -n.x), vec3<f32>(both, 1.0 - n.y * n.y * a, -n.y), n);
}

// The frame of any vector n, normalized; the axes if n has no direction. At (0, 0, -1) it is the
// half turn about x.
fn frame_from_normal(n: vec3<f32>) -> Frame {
    let direction = frame_direction(n);
    if direction.x == 0.0 && direction.y == 0.0 && direction.z == 0.0 {
        return Frame(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(0.0, 0.0, 1.0));
    }
    return frame_of_direction(direction);
}

// The frame of n whose tangent is the part of t perpendicular to n; the frame of n alone if t has
// no such part.
fn frame_from_normal_tangent(n: vec3<f32>, t: vec3<f32>) -> Frame {
    var normal = frame_direction(n);
    if normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0 {
        normal = vec3<f32>(0.0, 0.0, 1.0);
    }
    let given = frame_direction(t);
    var across = given - normal * frame_product(normal, given);
    if frame_product(across, across) >= 1e-6 {
        // A second projection. The first leaves a part along n that 1e-3 rad magnifies to 1e-4.
        across = frame_direction(across);
        let tangent = frame_direction(across - normal * frame_product(normal, across));
        let bitangent = vec3<f32>(
            normal.y * tangent.z - tangent.y * normal.z,
            normal.z * tangent.x - tangent.z * normal.x,
            normal.x * tangent.y - tangent.x * normal.y,
        );
        return Frame(tangent, bitangent, normal);
    }
    return frame_from_normal(n);
}

// v in the frame.
fn frame_to_local(frame: Frame, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(frame_product(v, frame.tangent), frame_product(v, frame.bitangent), frame_product(v, frame.normal));
}

// The vector whose coordinates in the frame are v.
fn frame_to_world(frame: Frame, v: vec3<f32>) -> vec3<f32> {
    return frame.tangent * v.x + frame.bitangent * v.y + frame.normal * v.z;
}
