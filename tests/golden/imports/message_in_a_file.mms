// A message about an imported file is about that file.
import "parts/broken.mms";
// error E0201: `nowhere`
