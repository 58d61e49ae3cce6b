// SPDX-License-Identifier: Apache-2.0
// The same everywhere.
const value = 0.25 * 3.0;
