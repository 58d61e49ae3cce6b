// An alias gives a surface, of this file or an imported one, another name outside.
import "parts/surfaces.mms" as other;
surface grey bsdf = matte(0.5); end
plain alias grey;
"a long name" alias plain;
ruby alias other::red;
// expect-output: surface plain bsdf = matte(0.5)
// expect-output: surface ruby height = 0.25
