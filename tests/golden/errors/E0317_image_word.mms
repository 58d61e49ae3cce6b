// Filters, wrap modes and storages of images are words of a list.
real f() = image_value("wood.png", $uv, filter = "soft");
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0317: `soft` is no filter of images
