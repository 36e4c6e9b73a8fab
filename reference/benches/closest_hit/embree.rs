//! Embree 4, loaded at run time from the library named by the variable `EMBREE`. The library isn't
//! part of this project. The Python package `embreex` contains a copy.
//!
//! This is the only `unsafe` code outside the sandbox. There is no other way to call functions in a
//! C library. The declarations follow Embree 4's `rtcore.h`.
#![allow(
    unsafe_code,
    reason = "a C library that is loaded at run time, for comparison only"
)]

use std::ffi::{c_char, c_uint, c_void};
use std::ptr;

use libloading::Library;
use protocol::Ray;

use crate::mesh::Mesh;

type Handle = *mut c_void;

const TRIANGLES: c_uint = 0;
const INDEX_BUFFER: c_uint = 0;
const VERTEX_BUFFER: c_uint = 1;
const UINT3: c_uint = 0x5003;
const FLOAT3: c_uint = 0x9003;
/// `RTC_BUILD_QUALITY_MEDIUM`, the default: binned SAH without spatial splits.
const MEDIUM: c_uint = 1;
/// One thread, the caller's. Embree detects the processor's instruction set itself.
const CONFIGURATION: &[u8] = b"threads=1,user_threads=1\0";

/// `RTCRayHit`. The last fields differ between builds of the library. This structure is large
/// enough for either layout.
#[repr(C, align(16))]
struct RayHit {
    origin: [f32; 3],
    near: f32,
    dir: [f32; 3],
    time: f32,
    far: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: c_uint,
    geometry: c_uint,
    instance: [c_uint; 5],
}

/// The functions of the library that the benchmark calls.
pub struct Embree {
    device: Handle,
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    set_quality: unsafe extern "C" fn(Handle, c_uint),
    new_geometry: unsafe extern "C" fn(Handle, c_uint) -> Handle,
    new_buffer: unsafe extern "C" fn(Handle, c_uint, c_uint, c_uint, usize, usize) -> *mut c_void,
    commit_geometry: unsafe extern "C" fn(Handle),
    attach: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    release_geometry: unsafe extern "C" fn(Handle),
    commit_scene: unsafe extern "C" fn(Handle),
    release_scene: unsafe extern "C" fn(Handle),
    intersect: unsafe extern "C" fn(Handle, *mut RayHit, *mut c_void),
    // Declared last so that it is dropped last, since dropping it unloads the functions.
    _library: Library,
}

/// A tree built by the library.
pub struct EmbreeScene<'a> {
    embree: &'a Embree,
    scene: Handle,
}

impl Embree {
    /// Loads the library named by the variable `EMBREE`. Returns `None` if the variable isn't set.
    pub fn open() -> Option<Self> {
        let path = std::env::var_os("EMBREE")?;
        // SAFETY: by setting the variable, the user promises that the file is Embree 4, whose
        // start-up code is safe to run. The types match its header.
        unsafe {
            let library = Library::new(&path)
                .unwrap_or_else(|error| panic!("cannot open EMBREE={}: {error}", path.display()));
            macro_rules! function {
                ($name:literal) => {
                    *library
                        .get($name)
                        .unwrap_or_else(|error| panic!("EMBREE must be version 4: {error}"))
                };
            }
            let new_device: unsafe extern "C" fn(*const c_char) -> Handle =
                function!(b"rtcNewDevice\0");
            let device = new_device(CONFIGURATION.as_ptr().cast());
            assert!(!device.is_null(), "Embree cannot create a device");
            Some(Embree {
                device,
                new_scene: function!(b"rtcNewScene\0"),
                set_quality: function!(b"rtcSetSceneBuildQuality\0"),
                new_geometry: function!(b"rtcNewGeometry\0"),
                new_buffer: function!(b"rtcSetNewGeometryBuffer\0"),
                commit_geometry: function!(b"rtcCommitGeometry\0"),
                attach: function!(b"rtcAttachGeometry\0"),
                release_geometry: function!(b"rtcReleaseGeometry\0"),
                commit_scene: function!(b"rtcCommitScene\0"),
                release_scene: function!(b"rtcReleaseScene\0"),
                intersect: function!(b"rtcIntersect1\0"),
                _library: library,
            })
        }
    }

    /// Builds a tree over a mesh.
    pub fn build(&self, mesh: &Mesh) -> EmbreeScene<'_> {
        let count = mesh.corners.len();
        // SAFETY: handles come from the library and are released once. Both buffers are filled with
        // the requested size and format before they are committed.
        unsafe {
            let scene = (self.new_scene)(self.device);
            (self.set_quality)(scene, MEDIUM);
            let geometry = (self.new_geometry)(self.device, TRIANGLES);
            let points = (self.new_buffer)(geometry, VERTEX_BUFFER, 0, FLOAT3, 12, 3 * count);
            let indices = (self.new_buffer)(geometry, INDEX_BUFFER, 0, UINT3, 12, count);
            assert!(
                !points.is_null() && !indices.is_null(),
                "Embree is out of memory"
            );
            let (points, indices) = (points.cast::<f32>(), indices.cast::<u32>());
            let coordinates = mesh
                .corners
                .iter()
                .flatten()
                .flat_map(|point| point.to_array());
            for (i, coordinate) in coordinates.enumerate() {
                points.add(i).write(coordinate);
            }
            for (i, index) in (0..3 * count).zip(0..) {
                indices.add(i).write(index);
            }
            (self.commit_geometry)(geometry);
            (self.attach)(scene, geometry);
            (self.release_geometry)(geometry);
            (self.commit_scene)(scene);
            EmbreeScene {
                embree: self,
                scene,
            }
        }
    }
}

impl EmbreeScene<'_> {
    /// Returns the distance to the closest hit, or infinity if the ray hits nothing.
    pub fn distance(&self, ray: &Ray) -> f32 {
        let mut hit = RayHit {
            origin: ray.origin.to_array(),
            near: ray.range.min,
            dir: ray.dir.to_array(),
            time: 0.0,
            far: ray.range.max,
            mask: c_uint::MAX,
            id: 0,
            flags: 0,
            normal: [0.0; 3],
            uv: [0.0; 2],
            primitive: c_uint::MAX,
            geometry: c_uint::MAX,
            instance: [c_uint::MAX; 5],
        };
        // SAFETY: the scene is committed, and the structure is at least as large as the library's.
        unsafe { (self.embree.intersect)(self.scene, &raw mut hit, ptr::null_mut()) };
        if hit.geometry == c_uint::MAX {
            f32::INFINITY
        } else {
            hit.far
        }
    }
}

impl Drop for EmbreeScene<'_> {
    fn drop(&mut self) {
        // SAFETY: nothing else uses this handle.
        unsafe { (self.embree.release_scene)(self.scene) };
    }
}
