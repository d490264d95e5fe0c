-- Links from page to page, which are .md in the tree, are .html where they are read.
function Link(link)
  if not link.target:match("^%a+:") then
    link.target = link.target:gsub("%.md$", ".html"):gsub("%.md#", ".html#")
  end
  return link
end

-- Wide tables scroll by themselves, not the page with them.
function Table(block)
  return pandoc.Div({block}, pandoc.Attr("", {"wide"}, {tabindex = "0", role = "region"}))
end

-- The first heading is what a browser calls the page.
function Pandoc(page)
  for _, block in ipairs(page.blocks) do
    if block.t == "Header" and block.level == 1 then
      page.meta.pagetitle = "Talus: " .. pandoc.utils.stringify(block)
      break
    end
  end
  return page
end
