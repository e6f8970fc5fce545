#!/bin/sh
# Makes the site of docs/, the API's pages among them: build/site/index.html. The status is 1 where Doxygen or Sphinx warns, or where
# a link leads nowhere. The Python module has to be built (make python).
set -eu
cd "$(dirname "$0")/.."
scripts/docs.sh
rm -rf build/site build/site_pages
# Sphinx writes the API's pages beside those that it reads.
mkdir -p build/site_pages
for entry in *; do
  [ "$entry" = build ] || ln -s "../../$entry" build/site_pages/
done
PYTHONPATH=build/release/python /usr/bin/python3 -B -m sphinx -q -E -W --keep-going -c docs/site -d build/site_cache build/site_pages build/site
cp -r build/docs/html build/site/api/cpp
cp -r data/schema build/site/
# The furo of Debian 12 expects it from a server; that of Debian 13 has it.
if grep -q 'url(/javascript/normalize.css/' build/site/_static/styles/furo.css; then
  cp /usr/share/nodejs/normalize.css/normalize.css build/site/_static/styles/
  sed -i 's,url(/javascript/normalize.css/,url(,' build/site/_static/styles/furo.css
fi
cp build/site/README.html build/site/index.html
# Sphinx has looked at links between the documents' pages. This looks at all that pages name.
/usr/bin/python3 -B docs/site/links.py build/site
echo "The site: build/site/index.html, $(find build/site -type f | wc -l) files, $(du -sh build/site | cut -f1)"
