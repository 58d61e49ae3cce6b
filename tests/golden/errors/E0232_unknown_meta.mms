// What a tool is told of a param.
param real s = 1.0, tooltip = "Scale";
//                  ^^^^^^^ error E0232: `tooltip`
const a = s;
