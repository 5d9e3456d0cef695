#pragma once

/// The files of render/figure/page, word for word.
namespace automorph::page {

extern const char* const kHtml;  ///< with {{title}}, {{style}}, {{data}}, {{script}} to be filled in
extern const char* const kStyle;
extern const char* const kScript;

}  // namespace automorph::page
