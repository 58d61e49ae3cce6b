// A param and its range are known at link.
param real now = $time;
//               ^^^^^ error E0221
param real reach = 1 in [0, $time];
//                          ^^^^^ error E0221
