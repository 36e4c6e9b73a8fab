//! The steps of a correct path, from the first hit to the last.

use glam::DVec3;
use judging::drawing_data::{PathHit, PathStep};

use super::Numbers64;
use super::room::{Room, Surface64};
use super::transport::{direct, ray, scatter, survival};
use crate::oracle::Ray64;

/// Returns the steps of the path with these random numbers. Their light adds up to
/// [`radiance`](super::transport::radiance).
pub fn path_steps(room: &Room, start: &Ray64, numbers: &[Numbers64]) -> Vec<PathStep> {
    let mut steps = Vec::new();
    let mut from: Option<Surface64> = None;
    let mut ray_here = ray(start.origin, start.dir.normalize());
    let mut throughput = DVec3::ONE;
    let mut is_counted = false;
    for bounce in 0..=numbers.len() {
        let mut step = |hit: PathHit, position: DVec3, light: DVec3| {
            steps.push(PathStep {
                hit,
                position: position.as_vec3(),
                throughput: throughput.as_vec3(),
                light: (throughput * light).as_vec3(),
            });
        };
        let Some(surface) = room.hit(&ray_here, from.as_ref()).value else {
            let environment = room.sources().environment.radiance(ray_here.dir).value;
            let light = if is_counted { DVec3::ZERO } else { environment };
            step(
                PathHit::Nothing,
                ray_here.at(room.extent().1.max_element()),
                light,
            );
            break;
        };
        let emitted = if is_counted {
            DVec3::ZERO
        } else {
            surface.emitted
        };
        let Some(numbers) = numbers.get(bounce) else {
            step(surface.kind(), surface.position, emitted);
            break;
        };
        let direct = direct(room, &surface, numbers).value;
        step(surface.kind(), surface.position, emitted + direct);
        let Some(scattered) = scatter(&surface, numbers) else {
            break;
        };
        let scattered = scattered.value;
        throughput *= scattered.attenuation;
        let survival = survival(throughput, bounce, numbers).value;
        let Some(survival) = survival.filter(|_| throughput != DVec3::ZERO) else {
            break;
        };
        throughput /= survival;
        is_counted = scattered.pdf.is_some();
        let direction = surface.frame.to_world(scattered.direction);
        ray_here = ray(surface.position, direction);
        from = Some(surface);
    }
    steps
}
