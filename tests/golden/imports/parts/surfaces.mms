// Surfaces of a library of materials.
surface red bsdf = matte(rgb(0.5, 0, 0)); height = 0.25; end
