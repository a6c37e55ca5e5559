//! The built-in scenes: objects and views.

use std::sync::{Arc, LazyLock};

use asperity_shading::{
    Brdf, EnergyPreservingOrenNayar, Lambert, ShadingError, SurfacePoint, TemperedGlass,
    TemperedGlassParameters,
    bump::Facet,
    material::Material,
    reflectance::{Bsdf, Coat, Lobe},
};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    geometry::{
        camera::Camera,
        car::{WHEELS, arch, car_body, gap, grille, headlamp, wheel, window},
        mesh::{Mesh, TracedMesh},
        revolution::revolved,
        shape::Shape,
        teapot::teapot,
    },
    image::tone::hex,
    integrator::pixels::Sampling,
    materials::glazed,
    scene::{Object, Surface},
};

/// Sets of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// A ball of radius 1 on the ground.
    Sphere,
    /// The Utah teapot on the ground.
    Teapot,
    /// A plane up to the horizon.
    Plane,
    /// A car-like body on its wheels, in meters.
    Car,
    /// The corner of a room: the floor, a panel on the wall, a ball.
    Room,
    /// A wall, viewed along its surface.
    Wall,
    /// A vase on a table.
    Vase,
}

/// Position and angle of a camera, and its path from the whole to a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub eye: Vec3,
    pub target: Vec3,
    pub focus: Vec3,
    /// Full angle in degrees.
    pub field: f32,
}

impl View {
    /// Creates a view that zooms into its target.
    pub const fn new(eye: [f32; 3], target: [f32; 3], field: f32) -> Self {
        let target = Vec3::from_array(target);
        Self { eye: Vec3::from_array(eye), target, focus: target, field }
    }

    /// Returns the view that zooms into a point.
    pub const fn towards(self, focus: Vec3) -> Self {
        Self { focus, ..self }
    }

    /// Views the unit ball from the front, slightly from the right and above, just inside the
    /// image. Zooming leads to the point at the image center, or to the corner nearest to the
    /// viewer.
    pub fn of_mesh(mesh: &TracedMesh) -> Self {
        let eye = Vec3::new(1.3, -4.0, 1.7).normalize() / (0.48 * MESH_FIELD.to_radians()).sin();
        Self::of_mesh_from(mesh, eye, Vec3::ZERO, MESH_FIELD)
    }

    /// Views the unit ball from a point toward another, with a full angle in degrees. Zooming is
    /// that of [`of_mesh`](Self::of_mesh).
    pub fn of_mesh_from(mesh: &TracedMesh, eye: Vec3, target: Vec3, field: f32) -> Self {
        let hit = mesh.intersect(eye, (target - eye).normalize_or_zero());
        let focus = hit.map_or_else(|| mesh.nearest_corner(eye), |hit| hit.position);
        Self { eye, target, focus, field }
    }

    /// Returns the view rotated by an angle in degrees about the vertical through its target,
    /// counterclockwise from above.
    #[must_use]
    pub fn turned(self, degrees: f32) -> Self {
        if degrees == 0.0 {
            return self;
        }
        let (sin, cos) = degrees.to_radians().sin_cos();
        let from = self.eye - self.target;
        let round = Vec3::new(cos * from.x - sin * from.y, sin * from.x + cos * from.y, from.z);
        Self { eye: self.target + round, ..self }
    }

    /// Returns the camera: toward the target at zoom 1, and from there straight to the focus.
    pub fn camera(&self, zoom: f32, sampling: Sampling) -> Camera {
        let near = 1.0 / f64::from(zoom);
        let [whole, target, focus] = [self.eye, self.target, self.focus].map(Vec3::as_dvec3);
        // The aim turns to the focus faster than the camera approaches, so that the focus stays in
        // the image.
        let aim = focus + (target - focus) * near * near;
        let eye = focus + (whole - focus) * near;
        Camera::new(eye, aim, self.field.to_radians(), sampling.width, sampling.height)
    }
}

/// Full angle in degrees of the default view of a mesh.
const MESH_FIELD: f32 = 27.0;

/// Points of the vase's profile, radius and height.
const VASE_PROFILE: [[f32; 2]; 12] = [
    [0.0, 0.0],
    [0.44, 0.0],
    [0.50, 0.06],
    [0.62, 0.35],
    [0.86, 0.85],
    [0.84, 1.25],
    [0.58, 1.62],
    [0.38, 1.95],
    [0.40, 2.2],
    [0.52, 2.34],
    [0.48, 2.36],
    [0.34, 2.12],
];

/// Shapes shared by many images, created on first use.
static BALL: LazyLock<Arc<Shape>> = LazyLock::new(|| ball(Vec3::Z, 1.0).into());
pub(super) static TEAPOT: LazyLock<Arc<Shape>> = LazyLock::new(|| teapot().into());
static VASE: LazyLock<Arc<Shape>> = LazyLock::new(|| revolved(&VASE_PROFILE).into());
/// At height 0.
static DISC: LazyLock<Arc<Shape>> = LazyLock::new(|| disc(0.0).into());

/// Background color.
pub fn backdrop() -> Vec3 {
    hex(0x2a_2d33)
}

/// Background radiance in a direction; the ground fades into it.
pub type Behind<'a> = &'a (dyn Fn(Vec3) -> Vec3 + Sync);

/// The [`backdrop`] in every direction.
pub const PLAIN: Behind<'static> = &|_| backdrop();

impl Set {
    /// Returns the length of the scene's unit in meters.
    pub const fn metres(self) -> f32 {
        match self {
            Self::Sphere => 0.15,
            Self::Teapot => 0.05,
            Self::Vase => 0.2,
            Self::Plane | Self::Car | Self::Room | Self::Wall => 1.0,
        }
    }

    /// Returns the view of the whole, which zooms into a point of the subject's surface.
    pub const fn view(self) -> View {
        let (view, focus) = match self {
            Self::Sphere => {
                (View::new([0.0, -5.2, 1.9], [0.0, 0.0, 0.93], 25.0), [0.0, -0.993_323, 1.115_293])
            }
            Self::Teapot => (
                View::new([4.4, -12.6, 5.6], [0.25, 0.0, 1.42], 29.0),
                [-0.450_620_03, -1.848_625_9, 1.449_469_8],
            ),
            Self::Plane => (View::new([0.0, -2.0, 0.7], [0.0, 0.0, 0.28], 40.0), [0.0, 4.0 / 3.0, 0.0]),
            Self::Car => (
                View::new([4.4, -5.6, 1.9], [0.12, 0.0, 0.55], 32.0),
                [0.750_573_16, -0.825_049_04, 0.748_895_8],
            ),
            Self::Room => (View::new([0.75, -1.15, 0.95], [-0.25, 0.6, 0.22], 46.0), [-0.1, 0.3, 0.0]),
            Self::Wall => (View::new([-1.1, -1.5, 1.25], [0.3, 0.0, 1.1], 42.0), [0.3, 0.0, 1.1]),
            Self::Vase => {
                (View::new([0.0, -7.2, 2.6], [0.0, 0.0, 1.12], 25.0), [0.0, -0.822_866_86, 1.289_144_9])
            }
        };
        view.towards(Vec3::from_array(focus))
    }

    /// Returns the objects. The first has the subject's material.
    pub fn objects<'a>(
        self,
        subject: Box<Surface<'a>>,
        behind: Behind<'a>,
    ) -> Result<Vec<Object<'a>>, Failure> {
        Ok(match self {
            Self::Sphere => vec![Object::new(Arc::clone(&BALL), subject), ground(0.0, behind)?],
            Self::Teapot => vec![Object::new(Arc::clone(&TEAPOT), subject), ground(0.0, behind)?],
            Self::Vase => vec![Object::new(Arc::clone(&VASE), subject), ground(0.0, behind)?],
            Self::Plane => vec![Object::new(Shape::Plane, subject)],
            Self::Car => car(subject, behind)?,
            Self::Room => {
                let floor = Mesh::parallelogram(Vec3::new(-1.0, -1.6, 0.0), [Vec3::X * 3.0, Vec3::Y * 2.9]);
                let back = Mesh::parallelogram(Vec3::new(-1.0, 1.3, 0.0), [Vec3::X * 3.0, Vec3::Z * 1.6]);
                let left = Mesh::parallelogram(Vec3::new(-1.0, -1.6, 0.0), [Vec3::Y * 2.9, Vec3::Z * 1.6]);
                vec![
                    Object::new(floor, subject),
                    Object::new(back, Lambert::new(hex(0xb9_b2a6))?),
                    Object::new(left, Lambert::new(hex(0xa9_a49c))?),
                    Object::new(ball(Vec3::new(-0.42, 0.72, 0.2), 0.2), glazed(0.08, hex(0xc9_4a2c))),
                ]
            }
            Self::Wall => {
                let wall = Mesh::parallelogram(Vec3::new(-2.0, 0.0, 0.0), [Vec3::X * 60.0, Vec3::Z * 4.0]);
                let floor = Mesh::parallelogram(Vec3::new(-2.0, -9.0, 0.0), [Vec3::X * 60.0, Vec3::Y * 9.0]);
                vec![Object::new(wall, subject), Object::new(floor, cloth(hex(0x6b_665e))?)]
            }
        })
    }
}

/// Creates a disc of cloth at this height that fades into the background.
pub fn ground(height: f32, behind: Behind<'_>) -> Result<Object<'_>, Failure> {
    faded_disc(height, hex(0x8d_8377), [2.5, 6.0], behind)
}

/// Returns a rough color.
fn cloth(color: Vec3) -> Result<EnergyPreservingOrenNayar, ShadingError> {
    EnergyPreservingOrenNayar::new(color, 0.8)
}

fn disc(height: f32) -> Mesh {
    revolved(&[[60.0, height], [9.0, height], [0.0, height]])
}

/// Creates a disc of cloth that fades into the background over `over`, starting at a radius.
fn faded_disc(
    height: f32,
    color: Vec3,
    [from, over]: [f32; 2],
    behind: Behind<'_>,
) -> Result<Object<'_>, Failure> {
    let cloth = cloth(color)?;
    let shape = if height == 0.0 { Arc::clone(&DISC) } else { disc(height).into() };
    Ok(Object::shaded(shape, move |point, wo| {
        let distance = point.position.truncate().length();
        let kept = (-((distance - from).max(0.0) / over).powi(2)).exp();
        let sent = Bsdf::new(point.frame(), wo).with_emitted((1.0 - kept) * behind(-wo));
        // Nearly transparent parts are not sampled, because their weight is within the rounding of
        // the density.
        if kept < 1e-4 {
            sent
        } else {
            sent.with([Facet::FLAT], [Lobe::from(cloth).weighted(Vec3::splat(kept))])
        }
    }))
}

/// Creates a ball.
fn ball(center: Vec3, radius: f32) -> Mesh {
    let points: Vec<[f32; 2]> = (0..=12)
        .map(|k| ((k as f32 / 12.0 - 0.5) * std::f32::consts::PI).sin_cos())
        .map(|(sin, cos)| [radius * cos.max(0.0), radius * sin])
        .collect();
    let mut mesh = revolved(&points);
    for vertex in &mut mesh.vertices {
        // The spline deviates slightly from the circle.
        vertex.normal = vertex.position.normalize_or(vertex.normal);
        vertex.position = center + radius * vertex.normal;
        vertex.uv *= Vec2::new(radius, 1.0);
    }
    mesh
}

/// The body of the car: paint, windows over a dark interior, and seals.
struct Body<'a> {
    paint: Box<Surface<'a>>,
    pane: TemperedGlass,
    seal: Lambert,
    /// The inside of the headlamps.
    mirror: Lambert,
}

impl Material for Body<'_> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let depth = window(point.position, point.normal);
        let lamp = headlamp(point.position, point.normal);
        if depth > 0.012 || lamp > 0.006 {
            let behind = if lamp > 0.006 { &self.mirror } else { &self.seal };
            self.pane.bsdf(point, wo).with([Facet::FLAT], [Lobe::from(behind as &dyn Brdf)])
        } else if depth > 0.0
            || lamp > 0.0
            || arch(point.position)
            || gap(point.position, point.normal)
            || grille(point.position)
        {
            self.seal.bsdf(point, wo)
        } else {
            self.paint.bsdf(point, wo)
        }
    }
}

/// The car: paint, windows and tires.
fn car<'a>(paint: Box<Surface<'a>>, behind: Behind<'a>) -> Result<Vec<Object<'a>>, Failure> {
    let dark = TemperedGlassParameters { tint: Vec3::ZERO, ..Default::default() };
    let body = Body {
        paint,
        pane: TemperedGlass::new(dark)?,
        seal: Lambert::new(hex(0x16_1618))?,
        mirror: Lambert::new(hex(0x9a_9ca2))?,
    };
    let (mut tyres, mut discs) = (Mesh::default(), Mesh::default());
    for [x, z] in WHEELS {
        for side in [-1.0, 1.0] {
            let [tyre, disc] = wheel(Vec3::new(x, 0.77 * side, z));
            tyres.append(tyre);
            discs.append(disc);
        }
    }
    Ok(vec![
        Object::new(car_body(), body),
        faded_disc(0.0, hex(0x77_7470), [3.5, 5.0], behind)?,
        Object::new(tyres, cloth(hex(0x2a_2a2c))?),
        Object::new(discs, Coat::conductor(Vec3::new(0.62, 0.63, 0.65))),
    ])
}
