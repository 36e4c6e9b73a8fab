//! The same submissions in each platform's export format, and the platform's class lists.

use super::cases::{Case, Files};
use crate::harness::{TestClass, zip};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {
    Gradescope,
    Canvas,
    Moodle,
    GitHub,
    Plain,
}

/// A person in the class. The last person handed in nothing.
pub struct Student<'a> {
    pub number: usize,
    pub login: String,
    pub name: String,
    pub case: Option<&'a Case>,
}

impl Student<'_> {
    /// Returns the submission time as shown in the platform's list.
    fn time(&self) -> &str {
        self.case.map_or("", |case| case.time)
    }

    fn email(&self) -> String {
        format!("{}@example.edu", self.login)
    }
}

/// Returns a student for each case, plus one who handed in nothing.
pub fn students(cases: &[Case]) -> Vec<Student<'_>> {
    let titles = cases.iter().map(|case| (case.title, Some(case)));
    let all = titles.chain([("nothing", None)]).enumerate();
    let student = |(number, (title, case)): (usize, (&str, _))| Student {
        number,
        login: format!("zoe-{title}"),
        name: format!("Zoë O'{title}"),
        case,
    };
    all.map(student).collect()
}

impl Platform {
    pub const ALL: [Platform; 5] = [
        Platform::Gradescope,
        Platform::Canvas,
        Platform::Moodle,
        Platform::GitHub,
        Platform::Plain,
    ];

    /// Returns the class as this platform exports it.
    pub fn export(self, students: &[Student]) -> TestClass {
        let mut class = TestClass::named(match self {
            // The suffix that identifies GitHub Classroom's clones.
            Platform::GitHub => "pathtracing-submissions",
            Platform::Gradescope | Platform::Canvas | Platform::Moodle | Platform::Plain => {
                "export"
            }
        });
        if self == Platform::Gradescope {
            class = class.with("submission_metadata.yml", gradescope_metadata(students));
        }
        for student in students {
            let Some(case) = student.case else { continue };
            for (path, bytes) in self.files(student, &case.files) {
                class = class.with(&path, bytes);
            }
        }
        class
    }

    /// Returns the files of a submission as this platform names them.
    fn files(self, student: &Student, files: &Files) -> Files {
        let Student {
            number,
            login,
            name,
            ..
        } = student;
        let prefix = match self {
            Platform::Gradescope => format!("submission_{number}/"),
            Platform::Canvas => {
                let is_late = student.case.is_some_and(|case| case.title == "late");
                let late = if is_late { "LATE_" } else { "" };
                // Canvas writes the name in lower case and without punctuation.
                let letters = name.chars().filter(|c| c.is_alphanumeric());
                let who = letters.collect::<String>().to_lowercase();
                format!("{who}_{late}{}_{}_", 7000 + number, 9000 + number)
            }
            Platform::Moodle => format!("{name}_{number}_assignsubmission_file_/"),
            Platform::GitHub => format!("pathtracing-{login}/"),
            Platform::Plain => format!("{login}/"),
        };
        // Canvas has no folders, so students hand in an archive. On other platforms they may do so
        // too.
        let has_folders = files.iter().any(|(path, _)| path.contains('/'));
        let own_archive = files.iter().any(|(path, _)| path.ends_with(".zip"));
        let is_archive = match self {
            Platform::Canvas => has_folders,
            Platform::Plain => number % 2 == 0 && !own_archive,
            Platform::Gradescope | Platform::Moodle | Platform::GitHub => false,
        };
        if is_archive {
            // A plain class may contain an archive instead of a student's folder.
            let path = if self == Platform::Plain {
                format!("{login}.zip")
            } else {
                format!("{prefix}hw.zip")
            };
            return vec![(path, zip(files.clone()))];
        }
        let named = files.iter();
        let named = named.map(|(path, bytes)| (format!("{prefix}{path}"), bytes.clone()));
        named.collect()
    }

    /// Returns the platform's class lists, by kind.
    pub fn lists(self, students: &[Student]) -> Vec<(&'static str, String)> {
        let table = |header: &str, row: &dyn Fn(&Student) -> String| {
            let rows: String = students.iter().map(|student| row(student) + "\n").collect();
            format!("{header}\n{rows}")
        };
        let id = |student: &Student| 7000 + student.number;
        let canvas = "Student,ID,SIS User ID,SIS Login ID,Section,Tracing (1)";
        let canvas = table(canvas, &|s| format!("{},{},,{},A,", s.name, id(s), s.login));
        let times = |header: &str, key: &dyn Fn(&Student) -> String| {
            let header = format!("{header},datetime");
            table(&header, &|s| format!("{},\"{}\"", key(s), s.time()))
        };
        match self {
            Platform::Gradescope => {
                let grades = table("First Name,Last Name,SID,Email,Total Score", &|s| {
                    format!("Zoë,{},,{},", &s.name["Zoë ".len()..], s.email())
                });
                vec![("gradescope", grades)]
            }
            Platform::Canvas => {
                let times = times("Student,ID", &|s| format!("{},{}", s.name, id(s)));
                vec![("canvas", canvas), ("roster", times)]
            }
            Platform::Moodle => {
                let header = "Identifier,Full name,Email address,Grade,Last modified (submission)";
                let worksheet = table(header, &|s| {
                    let (number, name, email, time) = (s.number, &s.name, s.email(), s.time());
                    format!("Participant {number},{name},{email},,\"{time}\"")
                });
                vec![("moodle", worksheet)]
            }
            Platform::GitHub | Platform::Plain => {
                let times = times("name,username", &|s| format!("{},{}", s.name, s.login));
                vec![("canvas", canvas), ("roster", times)]
            }
        }
    }

    /// Returns the name of the copied gradebook, the title of the column that identifies people,
    /// and the title of the column with the points.
    pub fn gradebook(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Platform::Gradescope => ("gradescope.csv", "Email", "Total Score"),
            Platform::Moodle => ("moodle.csv", "Full name", "Grade"),
            Platform::Canvas | Platform::GitHub | Platform::Plain => {
                ("canvas.csv", "Student", "Tracing (1)")
            }
        }
    }

    /// Returns a person's cell in the gradebook's identifying column.
    pub fn key(self, student: &Student) -> String {
        match self {
            Platform::Gradescope => student.email(),
            Platform::Canvas | Platform::Moodle | Platform::GitHub | Platform::Plain => {
                student.name.clone()
            }
        }
    }
}

fn gradescope_metadata(students: &[Student]) -> String {
    let submission = |student: &Student| {
        format!(
            "submission_{}:\n  :submitters:\n  - :name: {}\n    :email: {}\n  :created_at: {}\n",
            student.number,
            student.name,
            student.email(),
            student.time()
        )
    };
    let handed_in = students.iter().filter(|student| student.case.is_some());
    format!("---\n{}", handed_in.map(submission).collect::<String>())
}
