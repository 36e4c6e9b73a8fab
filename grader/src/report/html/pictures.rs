//! Pictures: the right one, the submission's, and where they differ.
//!
//! Without a script all of them stand side by side. `page.js` adds the slider and the flicker.

use glam::UVec2;
use maud::{Markup, html};

use super::mask;
use super::png::data_uri;
use super::said::{command, rows, said};
use crate::again::Again;
use crate::describe;
use crate::exam::Item;
use crate::exhibit::Exhibits;
use crate::picture::{self, Picture, Spot, View};

/// The width of the plane on which marks are placed, whatever the film.
const PLANE: f32 = 64.0;
/// The radius of a mark: at the mask's width of 256 pixels of the screen, large enough to be hit.
const RING: f32 = 3.2;

/// The pictures of an item that failed, question by question.
pub(super) fn failing(item: &Item, exhibits: &Exhibits, again: &Again) -> Markup {
    let answers =
        (0..item.questions.len()).filter_map(|i| Some((i, exhibits.answer(&item.id, i)?)));
    let pictures = answers.filter_map(|(question, answer)| {
        Some(Shown {
            item,
            question,
            picture: picture::of(&item.questions[question], answer)?,
            again,
            told: |element| describe::answer::got(answer, element),
        })
    });
    html! {
        @for shown in pictures { (shown.markup()) }
    }
}

/// The pictures of an item that passed: the submission's own, which are also the right ones.
pub(super) fn passed(item: &Item, exhibits: &Exhibits) -> Markup {
    let asked = item.questions.iter().enumerate();
    let pictures = asked.filter_map(|(question, asked)| {
        let answer = exhibits.answer(&item.id, question)?;
        picture::received(asked, answer)
    });
    html! {
        @for picture in pictures {
            div .panels {
                @for plate in &picture.plates {
                    (panel(picture.film, plate.name, &plate.pixels, "yours"))
                }
            }
        }
    }
}

/// One picture, and where it comes from. `told` says what the submission answered to an element.
struct Shown<'a, F: Fn(usize) -> String> {
    item: &'a Item,
    question: usize,
    picture: Picture,
    again: &'a Again,
    told: F,
}

impl<F: Fn(usize) -> String> Shown<'_, F> {
    fn markup(&self) -> Markup {
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
                    @for view in &picture.views { (row(picture, view)) }
                }
            }
        }
    }

    fn title(&self) -> String {
        let pictures = self.item.questions.iter().enumerate();
        let mut pictures = pictures.filter(|(_, asked)| picture::is_asked(asked));
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
                @if self.picture.views.len() > 1 {
                    fieldset {
                        legend { "Compare" }
                        @for (place, view) in self.picture.views.iter().enumerate() {
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
                    svg .marks viewBox=(format!("0 0 {PLANE} {PLANE}")) role="group" aria-label="the worst pixels" {
                        @for (place, spot) in picture.spots.iter().enumerate() {
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
            @if !self.picture.spots.is_empty() {
                h5 { "The worst pixels" }
                ol .spots {
                    @for (place, spot) in self.picture.spots.iter().enumerate() {
                        @let number = self.item.number(self.question, spot.element);
                        li {
                            details #(self.id(place)) .spot data-x=(spot.pixel.x) data-y=(spot.pixel.y) {
                                summary { (words(spot)) }
                                (rows(
                                    &describe::element(&asked.question, spot.element),
                                    &(self.told)(spot.element),
                                    &describe::answer::wanted(asked, spot.element).join(", or "),
                                ))
                                p .again {
                                    "Ask it again: "
                                    (command(&self.again.replay(&self.item.id, number)))
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

fn words(spot: &Spot) -> String {
    let (x, y) = (spot.pixel.x, spot.pixel.y);
    format!("pixel ({x}, {y}): {}", mask::title(spot.aspect))
}

/// One view: right, submitted, apart.
fn row(picture: &Picture, view: &View) -> Markup {
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
fn mark(picture: &Picture, spot: &Spot, number: usize, id: &str) -> Markup {
    let place = (spot.pixel.as_vec2() + 0.5) / picture.film.as_vec2();
    // Not so near to the border that half of it is cut off; the pixel stays within.
    let inside = |along: f32| (along * PLANE).clamp(RING + 0.4, PLANE - RING - 0.4);
    let (across, down) = (inside(place.x), inside(1.0 - place.y));
    html! {
        a href=(format!("#{id}")) aria-label=(format!("{number}: {}", words(spot))) {
            circle cx=(across) cy=(down) r=(RING) {}
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
                @for (aspect, count) in &picture.wrong {
                    tr {
                        th scope="row" {
                            img src=(mask::patch(*aspect)) alt="" width="16" height="16"; " "
                            (said(mask::title(*aspect)))
                        }
                        td .number { (count) }
                    }
                }
            }
        }
    }
}
