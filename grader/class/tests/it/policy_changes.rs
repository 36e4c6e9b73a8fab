//! If a change of the policy changes a final grade, the settings that caused the change are named.

use crate::harness::TestClass;

/// Ann's submission is 46 hours late in UTC and earns 2 of 4 points. Bob has two submissions.
const ROSTER: &str = "name,username,sid,datetime\n\
    Ann,ann,u1,2026-11-22 10:00:00\nBob,bob,u2,2026-11-18 10:00:00\n";
const BASE: [&str; 5] = [
    "points.out_of = 100",
    "late.due = 2026-11-20T12:00:00Z",
    "late.timezone = 'UTC'",
    "late.percent_per_day = 10",
    "attempts.counts = 'ask'",
];
const VOID: &str = "points.void = ['camera.unit_length']";

/// Returns a policy with these lines and with those in [`BASE`] for other settings.
fn policy(lines: &str) -> String {
    let is_other = |base: &&&str| !lines.contains(base.split(" = ").next().unwrap());
    let others: Vec<&str> = BASE.iter().filter(is_other).copied().collect();
    format!("{lines}\n{}\n", others.join("\n"))
}

#[test]
fn every_setting_that_changes_a_grade_is_named() {
    let class = TestClass::named("class")
        .with_offset_mistake("ann")
        .with_reference("bob")
        .with_starter("u2");
    let exam = class.small_exam(&["camera.offset", "camera.unit_length", "sphere.radius"]);
    class.graded_with(&exam, &[("roster", ROSTER)], &[]);
    let by_void = [VOID, "\npoints.void_points = 'give'"].concat();
    let cases = [
        ["", "points.out_of = 50"],
        [
            "points.out_of = 99",
            "points.out_of = 99\npoints.rounding = 'down'",
        ],
        ["", VOID],
        [VOID, &by_void],
        ["", "points.tasks.camera = 40"],
        ["", "late.due = 2026-11-21T12:00:00Z"],
        ["", "late.timezone = 'America/New_York'"],
        ["", "late.grace_minutes = 2880"],
        ["", "late.free_days = 1"],
        ["", "late.percent_per_day = 20"],
        ["", "late.percent_of = 'possible'"],
        ["", "late.most_percent = 30"],
        ["", "late.closed_after_days = 1"],
        ["", "late.extensions.ann = 1"],
        ["", "attempts.counts = 'best'"],
        // Each of two settings matters to a different person.
        ["", "late.free_days = 1\nattempts.counts = 'best'"],
        // Either of two settings would be enough.
        ["", "late.extensions.ann = 2\nlate.free_days = 2"],
    ];
    let graded = |lines: &str| class.graded_with(&exam, &[("policy", &policy(lines))], &[]);
    let changes = cases.map(|[before, after]| {
        graded(before);
        let text = graded(after);
        let lines = text.lines().filter(|line| line.contains(" → "));
        let lines: Vec<&str> = lines.map(str::trim).collect();
        lines.join("\n")
    });
    insta::assert_snapshot!(changes.join("\n"), @r"
    ann (Ann): 40 of 100 → 20 of 50: `out_of` in the policy
    ann (Ann): 40 → 39: `rounding` in the policy
    ann (Ann): 40 → 27: `void` in the policy
    ann (Ann): 27 → 40: `void_points` in the policy
    ann (Ann): 40 → 28: `tasks` in the policy
    ann (Ann): 40 → 45: days late 2 → 1, `due` in the policy
    ann (Ann): 40 → 35: days late 2 → 3, `timezone` in the policy
    ann (Ann): 40 → 50: days late 2 → 0, `grace_minutes` in the policy
    ann (Ann): 40 → 45: `free_days` in the policy
    ann (Ann): 40 → 30: `percent_per_day` in the policy
    ann (Ann): 40 → 30: `percent_of` in the policy
    ann (Ann): 40 → 30: `most_percent` in the policy
    ann (Ann): 40 → 0: `closed_after_days` in the policy
    ann (Ann): 40 → 45: days late 2 → 1, `extensions` in the policy
    bob (Bob): no points (several attempts) → 100: `counts` in the policy
    ann (Ann): 40 → 45: `free_days` in the policy
    bob (Bob): no points (several attempts) → 100: `counts` in the policy
    ann (Ann): 40 → 50: days late 2 → 0, the policy
    ");
}
