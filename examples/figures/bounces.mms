// Thesis Figure 4.14: light that was scattered once, twice, three times, and as often as it takes. What
// few bounces leave out is darkness, not noise: a glance at a scene takes no more.
//
//   mms render bounces.mms --scene cornell --max-depth 1 --size 256x256 -o direct.png
//   ... --max-depth 2 -o one_bounce.png, --max-depth 3 -o two_bounces.png, and without, -o all.png

surface bounces
    bsdf = matte(0.75);
end
