#include "image/files.hpp"
#include "image/read.hpp"
#include "image/write.hpp"

extern "C" {
extern const facet::image::file_functions facet_picture_files;
const facet::image::file_functions facet_picture_files{facet::image::read_picture,
                                                       facet::image::write_picture};
}
