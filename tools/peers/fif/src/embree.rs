//! The dozen functions of Embree 3 and 4 required by a mesh and `rtcIntersect1`.

use std::{
    ffi::{c_char, c_int, c_uint, c_void},
    ptr, slice,
};

type Handle = *mut c_void;

#[derive(Default)]
#[repr(C, align(16))]
struct RayHit {
    origin: [f32; 3],
    t_near: f32,
    direction: [f32; 3],
    time: f32,
    t_far: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: c_uint,
    geometry: c_uint,
    instance: c_uint,
    #[cfg(not(embree3))]
    instance_primitive: c_uint,
}

/// Embree 3 requires a context for every ray.
#[cfg(embree3)]
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *mut c_void,
    instance: [c_uint; 1],
}

unsafe extern "C" {
    fn rtcNewDevice(config: *const c_char) -> Handle;
    fn rtcReleaseDevice(device: Handle);
    fn rtcNewScene(device: Handle) -> Handle;
    fn rtcReleaseScene(scene: Handle);
    fn rtcNewGeometry(device: Handle, kind: c_int) -> Handle;
    fn rtcSetNewGeometryBuffer(
        geometry: Handle,
        kind: c_int,
        slot: c_uint,
        format: c_int,
        stride: usize,
        count: usize,
    ) -> *mut c_void;
    fn rtcCommitGeometry(geometry: Handle);
    fn rtcAttachGeometry(scene: Handle, geometry: Handle) -> c_uint;
    fn rtcReleaseGeometry(geometry: Handle);
    fn rtcCommitScene(scene: Handle);
    #[cfg(not(embree3))]
    fn rtcIntersect1(scene: Handle, ray: *mut RayHit, arguments: *mut c_void);
    #[cfg(embree3)]
    fn rtcIntersect1(scene: Handle, context: *mut Context, ray: *mut RayHit);
}

const TRIANGLES: c_int = 0;
const INDICES: c_int = 0;
const VERTICES: c_int = 1;
const UINT3: c_int = 0x5003;
const FLOAT3: c_int = 0x9003;
const NONE: c_uint = c_uint::MAX;

/// The triangles of a height field over equal cells.
pub(crate) struct Mesh {
    device: Handle,
    scene: Handle,
}

impl Mesh {
    /// Creates two triangles for each of `side²` cells of the square `[0, 2]²`, built with one
    /// thread.
    pub(crate) fn new(side: usize, height: impl Fn(usize, usize) -> f64) -> Self {
        let nodes = side + 1;
        // SAFETY: the calls follow Embree's manual, in its order. Embree owns both buffers, which
        // are large enough for the writes and not used after the scene is committed.
        unsafe {
            let device = rtcNewDevice(c"threads=1".as_ptr());
            let scene = rtcNewScene(device);
            let geometry = rtcNewGeometry(device, TRIANGLES);
            let vertices = rtcSetNewGeometryBuffer(geometry, VERTICES, 0, FLOAT3, 12, nodes * nodes);
            let vertices = slice::from_raw_parts_mut(vertices.cast::<[f32; 3]>(), nodes * nodes);
            let place = |i: usize| 2.0 * i as f64 / side as f64;
            for (k, vertex) in vertices.iter_mut().enumerate() {
                let (i, j) = (k / nodes, k % nodes);
                *vertex = [place(i) as f32, place(j) as f32, height(i, j) as f32];
            }
            let triangles = rtcSetNewGeometryBuffer(geometry, INDICES, 0, UINT3, 12, 2 * side * side);
            let triangles = slice::from_raw_parts_mut(triangles.cast::<[c_uint; 3]>(), 2 * side * side);
            for (k, pair) in triangles.chunks_exact_mut(2).enumerate() {
                let a = (k / side * nodes + k % side) as c_uint;
                let b = a + nodes as c_uint;
                pair.copy_from_slice(&[[a, b, a + 1], [b, b + 1, a + 1]]);
            }
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
            rtcCommitScene(scene);
            Self { device, scene }
        }
    }

    /// Returns `t` of the first hit, or infinity.
    #[inline]
    pub(crate) fn intersect(&self, origin: [f32; 3], direction: [f32; 3]) -> f32 {
        let mut ray = RayHit {
            origin,
            direction,
            t_far: f32::INFINITY,
            mask: NONE,
            primitive: NONE,
            geometry: NONE,
            instance: NONE,
            #[cfg(not(embree3))]
            instance_primitive: NONE,
            ..RayHit::default()
        };
        // SAFETY: the scene is committed, and the ray has the layout and alignment of Embree's
        // `RTCRayHit`.
        #[cfg(not(embree3))]
        unsafe {
            rtcIntersect1(self.scene, &raw mut ray, ptr::null_mut());
        }
        // SAFETY: as above, and the context has the layout of `RTCIntersectContext`.
        #[cfg(embree3)]
        unsafe {
            let mut context = Context { flags: 0, filter: ptr::null_mut(), instance: [NONE] };
            rtcIntersect1(self.scene, &raw mut context, &raw mut ray);
        }
        if ray.geometry == NONE { f32::INFINITY } else { ray.t_far }
    }
}

impl Drop for Mesh {
    fn drop(&mut self) {
        // SAFETY: both came from Embree and are released once.
        unsafe {
            rtcReleaseScene(self.scene);
            rtcReleaseDevice(self.device);
        }
    }
}
