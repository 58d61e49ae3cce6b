// A string ends on its line.
param real s = 1, label = "Scale;
//                        ^ error E0105: no closing quote
