// The thesis' Figures 6.9 to 6.14: its glossy reflection beside older models. Each row of four balls
// begins with the surface named here:
//
//   mms render glossy.mms --scene glossy.json --surface matte_ball --size 512x144 -o 6.9.png
//   ... --surface latitude_little (6.10), longitude_little (6.11), gloss_little (6.12)
//   mms render glossy.mms --scene glossy_normal.json --surface gloss_more --size 160x160 -o 6.13-left.png
//   mms render glossy.mms --scene glossy_grazing.json --surface gloss_more --size 160x160 -o 6.13-right.png
//   mms render glossy.mms --scene glossy_knot.json --surface knot_2 --size 512x220 -o 6.14.png
//
// 6.9 shows gloss "just a bit" above matte: both Phong lobes are black where nothing is reflected, the two
// on the right have edges. None of the four but matte keeps all energy; the thesis' model, in the rows
// below it, does. 6.10 is its latitudal factor alone, 6.11 its longitudal one, 6.12 their product.

const spectrum white = 0.85;

// Figure 6.9.
surface matte_ball
    bsdf = matte(white);
end
surface phong_ball
    bsdf = phong(white, 1.0);
end
surface max_phong_ball
    bsdf = max_phong(white, 1.0);
end
surface microfacet_ball
    bsdf = microfacet(white, 0.85);
end

// Figure 6.10.
surface latitude_little
    bsdf = glossy_product(white, 1.0, 0.0);
end
surface latitude_medium
    bsdf = glossy_product(white, 5.0, 0.0);
end
surface latitude_large
    bsdf = glossy_product(white, 40.0, 0.0);
end
surface latitude_mirror
    bsdf = glossy_product(white, 1000.0, 0.0);
end

// Figure 6.11.
surface longitude_little
    bsdf = glossy_product(white, 0.0, 1.0);
end
surface longitude_medium
    bsdf = glossy_product(white, 0.0, 5.0);
end
surface longitude_large
    bsdf = glossy_product(white, 0.0, 40.0);
end
surface longitude_mirror
    bsdf = glossy_product(white, 0.0, 1000.0);
end

// Figure 6.12, and 6.13 with one of them.
surface gloss_little
    bsdf = glossy(white, 0.8);
end
surface gloss_medium
    bsdf = glossy(white, 3.0);
end
surface gloss_more
    bsdf = glossy(white, 10.0);
end
surface gloss_large
    bsdf = glossy(white, 60.0);
end

// Figure 6.14.
surface knot_2
    bsdf = glossy(white, 2.0);
end
surface knot_4
    bsdf = glossy(white, 4.0);
end
