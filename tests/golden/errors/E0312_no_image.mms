// An image that cannot be read, with every place that names it.
real f() = image_value("wood.png", $uv);
//         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error E0312: the image `wood.png` cannot be read
