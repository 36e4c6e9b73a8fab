//! Properties of lateness: submitting later is never better. This is tested in various time zones,
//! when clocks are set forward and back, and on leap days.

use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp};
use proptest::prelude::*;

use super::{Policy, read_time};

/// Time zones with different rules: an offset in whole hours, daylight saving by half an hour, an
/// offset in quarter hours, and no offset.
const ZONES: [&str; 5] = [
    "Europe/Berlin",
    "America/New_York",
    "Australia/Lord_Howe",
    "Asia/Kathmandu",
    "UTC",
];
/// Moments around which clocks change or days are counted differently.
const MOMENTS: [&str; 5] = [
    "2026-10-25T01:00:00Z",
    "2027-03-28T01:00:00Z",
    "2026-11-01T06:00:00Z",
    "2028-02-29T12:00:00Z",
    "2027-12-31T23:59:59Z",
];

fn zone() -> impl Strategy<Value = TimeZone> {
    prop::sample::select(ZONES.to_vec()).prop_map(|name| TimeZone::get(name).unwrap())
}

fn moment() -> impl Strategy<Value = Timestamp> {
    let near = prop::sample::select(MOMENTS.to_vec());
    (near, -200_000i64..200_000).prop_map(|(near, seconds)| {
        let near: Timestamp = near.parse().unwrap();
        near + SignedDuration::from_secs(seconds)
    })
}

fn policy() -> impl Strategy<Value = Policy> {
    let rounding = prop::sample::select(vec!["up", "down", "nearest"]);
    let numbers = (1u32..200, 0u32..90, 0u32..3, 0u32..=100, 0u32..=100);
    (rounding, numbers, prop::option::of(0u32..9), any::<bool>()).prop_map(
        |(rounding, (out_of, grace, free, percent, most), closed, is_of_possible)| {
            let closed = closed.map_or(String::new(), |days| {
                format!("closed_after_days = {days}\n")
            });
            let of = if is_of_possible { "possible" } else { "earned" };
            let text = format!(
                "[points]\nout_of = {out_of}\nrounding = \"{rounding}\"\n[late]\n\
                grace_minutes = {grace}\nfree_days = {free}\npercent_per_day = {percent}\n\
                percent_of = \"{of}\"\nmost_percent = {most}\n{closed}"
            );
            Policy::from_text("policy.toml".as_ref(), &text).unwrap()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn who_submits_later_never_gets_more(
        policy in policy(),
        due in moment(),
        times in (moment(), moment()),
        zones in (zone(), zone()),
        own_zone in prop::option::of(zone()),
        points in 0u32..=100,
        manual in -20i32..20,
    ) {
        let mut policy = policy;
        policy.late.due = Some(due);
        policy.late.timezone = own_zone;
        let (early, late) = (times.0.min(times.1), times.0.max(times.1));
        // Platforms write each time with the offset of some time zone.
        let [early, late] = [(early, zones.0), (late, zones.1)].map(|(time, zone)| {
            let written = time.to_zoned(zone).strftime("%Y-%m-%d %H:%M:%S %z").to_string();
            policy.lateness(read_time(&written, None).unwrap(), &[]).unwrap()
        });
        prop_assert!(early <= late);
        let [early, late] = [early, late]
            .map(|lateness| policy.counted_points_with(points, 100, manual, lateness).points);
        prop_assert!(early >= late, "{early} < {late}");
    }

    #[test]
    fn a_time_without_offset_is_never_read_as_later_than_it_was(
        due in moment(),
        time in moment(),
        zone in zone(),
    ) {
        let policy = Policy { late: super::LatePolicy { due: Some(due), ..Policy::default().late }, ..Policy::default() };
        let written = time.to_zoned(zone.clone()).strftime("%Y-%m-%d %H:%M:%S").to_string();
        let read = read_time(&written, Some(&zone)).unwrap();
        let true_lateness = policy.lateness(time, &[]).unwrap();
        prop_assert!(policy.lateness(read, &[]).unwrap() <= true_lateness);
        // Only times in a repeated hour are read as different times.
        prop_assert!(read == time || time.duration_since(read) <= SignedDuration::from_hours(1));
    }

    #[test]
    fn more_points_never_count_less(
        policy in policy(),
        points in (0u32..=100, 0u32..=100),
        seconds in 0u64..1_000_000,
    ) {
        let lateness = super::Lateness::of_seconds(seconds);
        let counts = |points| policy.final_points(points, 100, lateness).points;
        let (few, many) = (points.0.min(points.1), points.0.max(points.1));
        prop_assert!(counts(few) <= counts(many));
    }
}
