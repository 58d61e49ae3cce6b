// Old bottle glass: green by absorption, with drifting cloudy streaks inside.
// A volume that varies may state the largest value of scattering + absorption; else it is enclosed (docs/bounds.md).
param real cloud = 7.0 in [0, 50], unit = "1/m", label = "Cloudiness";

surface murky_glass
    bsdf = dielectric(ior = 1.52);
end

volume murky_glass
    p          = $object_position;
    streak     = smoothstep(0.05, 0.55, fbm([2.2 * p.x, 5 * p.y, 2.2 * p.z], 4));
    scattering = cloud * streak * rgb(0.75, 0.95, 0.8);
    absorption = rgb(1.25, 0.18, 0.75);
    phase      = henyey_greenstein(0.3);
    bound      = cloud + 1.3;
end
