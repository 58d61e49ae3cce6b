// `!` is `not`, wherever it stands.
logic f(logic a, b) = !a == !b;
//                    ^ error E0140: `not` is not written `!`
//                          ^ error E0140: `not` is not written `!`
