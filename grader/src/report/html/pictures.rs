//! Pictures: the right one, the submission's, and where they differ.
//!
//! Without a script all of them stand side by side. `page.js` adds the slider and the flicker.

use glam::UVec2;
use maud::{Markup, html};

use super::elements::{command, evidence_table, plain_text};
use super::mask;
use super::png::data_uri;
use crate::describe;
use crate::exam::Item;
use crate::picture::{self, LayerComparison, Picture, WorstPixel};
use crate::report_answers::ReportAnswers;
use crate::rerun_command::RerunCommand;

/// The width of the plane on which marks are placed, whatever the film.
const MARKS_WIDTH: f32 = 64.0;
/// The radius of a mark: at the mask's width of 256 pixels of the screen, large enough to be hit.
const MARK_RADIUS: f32 = 3.2;

/// The pictures of an item that failed, question by question.
pub(super) fn failing(item: &Item, exhibits: &ReportAnswers, again: &RerunCommand) -> Markup {
    let answers =
        (0..item.questions.len()).filter_map(|i| Some((i, exhibits.answer(&item.id, i)?)));
    let pictures = answers.filter_map(|(question, answer)| {
        Some(WrongPicture {
            item,
            question,
            picture: picture::compare(&item.questions[question], answer)?,
            rerun: again,
            describe_got: |element| describe::answer::got(answer, element),
        })
    });
    html! {
        @for shown in pictures { (shown.render()) }
    }
}

/// The pictures of an item that passed: the submission's own, which are also the right ones.
pub(super) fn passed(item: &Item, exhibits: &ReportAnswers) -> Markup {
    let asked = item.questions.iter().enumerate();
    let pictures = asked.filter_map(|(question, asked)| {
        let answer = exhibits.answer(&item.id, question)?;
        picture::submitted_picture(asked, answer)
    });
    html! {
        @for picture in pictures {
            div .panels {
                @for plate in &picture.layers {
                    (panel(picture.film, plate.name, &plate.pixels, "yours"))
                }
            }
        }
    }
}

/// One picture, and where it comes from. `told` says what the submission answered to an element.
struct WrongPicture<'a, F: Fn(usize) -> String> {
    item: &'a Item,
    question: usize,
    picture: Picture,
    rerun: &'a RerunCommand,
    describe_got: F,
}

impl<F: Fn(usize) -> String> WrongPicture<'_, F> {
    fn render(&self) -> Markup {
        let picture = &self.picture;
        html! {
            div .picture data-columns=(picture.film.x) data-rows=(picture.film.y) {
                h4 { (self.title()) }
                div .overview {
                    (self.compare())
                    div { (self.mask()) (legend(picture)) }
                }
                (self.spots())
                h5 { "Side by side" }
                div .panels {
                    @for view in &picture.layers { (row(picture, view)) }
                }
            }
        }
    }

    fn title(&self) -> String {
        let pictures = self.item.questions.iter().enumerate();
        let mut pictures = pictures.filter(|(_, asked)| picture::asks_for_picture(asked));
        let place = pictures
            .clone()
            .position(|(question, _)| question == self.question);
        match (pictures.nth(1), place) {
            (Some(_), Some(place)) => format!("Picture {}", place + 1),
            (None, _) | (_, None) => "The picture".to_owned(),
        }
    }

    /// What the script brings to life: one view at a time, the right one beneath the submission's.
    fn compare(&self) -> Markup {
        let group = format!("{}-{}-view", self.item.id, self.question);
        html! {
            div .compare hidden {
                @if self.picture.layers.len() > 1 {
                    fieldset {
                        legend { "Compare" }
                        @for (place, view) in self.picture.layers.iter().enumerate() {
                            label {
                                input type="radio" name=(group) value=(view.name) checked[place == 0];
                                " " (view.name)
                            }
                        }
                    }
                }
                div .frame .stage {
                    img .wanted alt="";
                    img .got alt="";
                }
                div .controls {
                    label .ends {
                        span { "right" span .quiet { " to " } }
                        input type="range" min="0" max="100" value="50" step="1";
                        span { "yours" }
                    }
                    button type="button" .flicker aria-pressed="false" { "Flicker" }
                }
            }
        }
    }

    fn mask(&self) -> Markup {
        let picture = &self.picture;
        html! {
            figure {
                div .frame {
                    img src=(mask::mask(picture)) alt="the pixels in which something is wrong, as listed below";
                    svg .marks viewBox=(format!("0 0 {MARKS_WIDTH} {MARKS_WIDTH}")) role="group" aria-label="the worst pixels" {
                        @for (place, spot) in picture.worst_pixels.iter().enumerate() {
                            (mark(picture, spot, place + 1, &self.id(place)))
                        }
                    }
                }
                figcaption { "what is wrong" }
            }
        }
    }

    fn spots(&self) -> Markup {
        let asked = &self.item.questions[self.question];
        html! {
            @if !self.picture.worst_pixels.is_empty() {
                h5 { "The worst pixels" }
                ol .spots {
                    @for (place, spot) in self.picture.worst_pixels.iter().enumerate() {
                        @let number = self.item.number(self.question, spot.element);
                        li {
                            details #(self.id(place)) .spot data-x=(spot.pixel.x) data-y=(spot.pixel.y) {
                                summary { (spot_label(spot)) }
                                (evidence_table(
                                    &describe::element(&asked.question, spot.element),
                                    &(self.describe_got)(spot.element),
                                    &describe::answer::wanted(asked, spot.element).join(", or "),
                                ))
                                p .again {
                                    "Ask it again: "
                                    (command(&self.rerun.replay(&self.item.id, number)))
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    fn id(&self, place: usize) -> String {
        format!("{}-{}-spot-{}", self.item.id, self.question, place + 1)
    }
}

fn spot_label(spot: &WorstPixel) -> String {
    let (x, y) = (spot.pixel.x, spot.pixel.y);
    format!("pixel ({x}, {y}): {}", mask::aspect_name(spot.aspect))
}

/// One view: right, submitted, apart.
fn row(picture: &Picture, view: &LayerComparison) -> Markup {
    html! {
        div .row data-view=(view.name) {
            (panel(picture.film, view.name, &view.wanted, "right"))
            (panel(picture.film, view.name, &view.got, "yours"))
            (panel(picture.film, view.name, &view.difference, "difference, 4 ×"))
        }
    }
}

fn panel(film: UVec2, view: &str, pixels: &[picture::Colour], what: &str) -> Markup {
    let title = format!("{view}, {what}");
    html! {
        figure {
            div .frame { img src=(data_uri(film, pixels)) alt=(title); }
            figcaption { (title) }
        }
    }
}

/// A ring around a pixel of the mask, with its number; it leads to what is said of it.
fn mark(picture: &Picture, spot: &WorstPixel, number: usize, id: &str) -> Markup {
    let place = (spot.pixel.as_vec2() + 0.5) / picture.film.as_vec2();
    // Not so near to the border that half of it is cut off; the pixel stays within.
    let inside = |along: f32| {
        (along * MARKS_WIDTH).clamp(MARK_RADIUS + 0.4, MARKS_WIDTH - MARK_RADIUS - 0.4)
    };
    let (across, down) = (inside(place.x), inside(1.0 - place.y));
    html! {
        a href=(format!("#{id}")) aria-label=(format!("{number}: {}", spot_label(spot))) {
            circle cx=(across) cy=(down) r=(MARK_RADIUS) {}
            text x=(across) y=(down) dy="0.35em" text-anchor="middle" aria-hidden="true" { (number) }
        }
    }
}

/// What the mask's patterns mean, and how much there is of each.
fn legend(picture: &Picture) -> Markup {
    html! {
        table .legend {
            caption { "Wrong, of " (picture.positions) " places in " (picture.film.x) " × " (picture.film.y) " pixels" }
            thead {
                tr { th scope="col" { "What" } th scope="col" .number { "Places" } }
            }
            tbody {
                @for (aspect, count) in &picture.wrong_counts {
                    tr {
                        th scope="row" {
                            img src=(mask::patch(*aspect)) alt="" width="16" height="16"; " "
                            (plain_text(mask::aspect_name(*aspect)))
                        }
                        td .number { (count) }
                    }
                }
            }
        }
    }
}
