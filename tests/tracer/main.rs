//! The tracer: boolean operations on rays, the article's equation, the built-in scenes, and POV-Ray as a judge.

mod csg;
mod csg_oracle;
mod equation;
mod faces;
mod inspector;
mod media;
mod metamorphic;
mod parts;
mod povray;
mod povray_glass;
mod povray_scenes;
mod quality;
mod scenes;
mod space;
