// SPDX-License-Identifier: Apache-2.0
// Images from files. `at` is [u, v]: [0, 0] is the lower left corner of the picture, [1, 1] the upper
// right one. Names, and the words for filter, wrap, space, channel and storage, are known at link.
// What the pixel covers is filtered away, exactly as `$footprint` says, `width` times as wide
// (0: not at all) and wider by `blur`, a part of the picture: as much along both axes, or [along u,
// along v]. The pixel is an ellipse: up to 31 probes along its longer axis look at texels as wide as
// its shorter one, of levels of half the size each that the file has or that are made. Points and
// round pixels of square pictures come out as by OpenImageIO's texture calls; long pixels have other
// probes than there, and blurs add to the pixel as squares. `storage` is how the picture is kept in
// memory: `raw`, or `compressed`, which is smaller, slower and not exact.

/// How `at` changes across the pixel along its x axis (column 0) or its y axis.
/// >>> image_step([0.5, 0.5], 0, 0)
/// [0, 0]
real[2] image_step(real[2] at, integer column, real width) = select
    [0.0, 0.0], if width == 0;
    width * intrinsic::along_footprint(at, column) otherwise;
end;

/// The colour of an image as a reflectance. `space` is that of the file's numbers: `auto` is what the
/// file says or its kind has, then `sRGB`, `linear`, or any that OpenColorIO knows.
/// >>> image("file.png", [0.5, 0.5])
spectrum image(string file, real[2] at, string filter = "smart", real width = 1.0, real blur = 0.0,
    string wrap = "repeat", string space = "auto", string storage = "raw") =
    rgb(image_rgb(file, at, [blur, blur], filter, width, wrap, space, storage));

/// The same with a blur for each axis.
/// >>> image("file.png", [0.5, 0.5], blur = [0.1, 0.0])
spectrum image(string file, real[2] at, blur, string filter = "smart", real width = 1.0,
    string wrap = "repeat", string space = "auto", string storage = "raw") =
    rgb(image_rgb(file, at, blur, filter, width, wrap, space, storage));

/// The colour of an image as [red, green, blue], linear: for lights, and to reckon with.
/// >>> image_rgb("file.exr", [0.5, 0.5])
real[3] image_rgb(string file, real[2] at, string filter = "smart", real width = 1.0,
    real blur = 0.0,
    string wrap = "repeat", string space = "auto", string storage = "raw") =
    image_rgb(file, at, [blur, blur], filter, width, wrap, space, storage);

/// The same with a blur for each axis.
/// >>> image_rgb("file.exr", [0.5, 0.5], blur = [0.0, 0.1])
real[3] image_rgb(string file, real[2] at, blur, string filter = "smart", real width = 1.0,
    string wrap = "repeat", string space = "auto", string storage = "raw") =
    image_colour(intrinsic::image(file, filter, wrap, space, "", storage), at,
        image_step(at, 0, width), image_step(at, 1, width), blur);

/// A number of an image: of the channel with that name or place from 0, or else the luminance. The
/// numbers are the file's own unless `space` says otherwise.
/// >>> image_value("file.png", [0.5, 0.5])
real image_value(string file, real[2] at, string channel = "", string filter = "smart",
    real width = 1.0, real blur = 0.0, string wrap = "repeat", string space = "linear",
    string storage = "raw") =
    image_value(file, at, [blur, blur], channel, filter, width, wrap, space, storage);

/// The same with a blur for each axis.
/// >>> image_value("file.png", [0.5, 0.5], blur = [0.1, 0.2])
real image_value(string file, real[2] at, blur, string channel = "", string filter = "smart",
    real width = 1.0, string wrap = "repeat", string space = "linear", string storage = "raw") =
    image_number(intrinsic::image(file, filter, wrap, space, channel, storage), at,
        image_step(at, 0, width), image_step(at, 1, width), blur);

/// A number that the file states: `width`, `height`, `channels`, or one of its metadata by name;
/// `fallback` where it states none.
/// >>> image_fact("file.png", "width")
real image_fact(string file, string name, real fallback = 0.0) = intrinsic::image_fact(
    intrinsic::image(file, "nearest", "clamp", "linear", "", "raw"), name, fallback);

/// Columns and rows of an image.
/// >>> image_size("file.png")
integer[2] image_size(string file) =
    [integer(image_fact(file, "width")), integer(image_fact(file, "height"))];

/// Luminous intensity, in candela, of the lamp of a photometric file (`.ies`, IES LM-63, type C) towards
/// `direction`, a unit vector; `down` is where the file's vertical angle is 0, `along` at a right angle to
/// it where the horizontal one is. 1 where the file is not there. The file's `candela` (the largest),
/// `lumens` and `watts` are facts: `image_fact(file, "lumens")`. A sphere of radius r has that intensity
/// where its radiance everywhere is `ies(file) / (pi r^2)`; `illuminant_d65($wavelength)` alone is 72 200 cd m^-2.
/// >>> ies("lamp.ies", [0, -1, 0])
real ies(string file, real[3] direction = $view, down = [0.0, -1.0, 0.0],
    real[3] along = [1.0, 0.0, 0.0])
    turns      = atan2(dot(direction, cross(along, down)), dot(direction, along)) / tau;
    half_turns = acos(clamp(dot(direction, down), -1, 1)) / pi;
    return image_value(file, [turns, half_turns], width = 0.0);
