-- Run by editors/neovim-test in a headless Neovim.

local function fail(text)
  io.write("FAILED: " .. text .. "\n")
  vim.cmd("cquit 1")
end

local function check(text, is)
  if is then
    io.write("ok   " .. text .. "\n")
  else
    fail(text)
  end
end

local function wait(text, is)
  check(text, vim.wait(60000, is, 50))
end

local function ask(method, more)
  local params = vim.tbl_extend("force", vim.lsp.util.make_position_params(), more or {})
  local answers = vim.lsp.buf_request_sync(0, method, params, 60000) or {}
  for _, answer in pairs(answers) do
    if answer.err then
      return nil, answer.err
    end
    return answer.result
  end
end

local function find(text)
  vim.fn.cursor(1, 1)
  check("`" .. text .. "` stands in the file", vim.fn.search("\\V" .. text, "c") > 0)
end

local ran, why = pcall(function()
  vim.cmd("edit my.pf")
  check("a .pf file is a form", vim.bo.filetype == "postform")
  wait("the server is attached", function()
    return #vim.tbl_values(vim.lsp.buf_get_clients(0)) == 1
  end)
  local client = vim.tbl_values(vim.lsp.buf_get_clients(0))[1]
  wait("the server is ready", function()
    return client.initialized
  end)

  find("R[vclear]")
  local hover = ask("textDocument/hover")
  check("hover explains", hover.contents.value:find("clearance plane", 1, true) ~= nil)
  check("hover has the current job", hover.contents.value:find("in bracket: **0.1**", 1, true) ~= nil)

  local lens = ask("textDocument/codeLens")
  check("the lens says the verdict", lens[1].command.title:find("^bracket: %d+ blocks, proven$") ~= nil)

  -- type a wrong word and see it underlined
  vim.fn.setline(vim.fn.search("^Machine Mill"), "Machine Mil")
  wait("a wrong word is underlined", function()
    return #vim.diagnostic.get(0) > 0
  end)
  vim.cmd("undo")
  wait("and no more when it is right", function()
    return #vim.diagnostic.get(0) == 0
  end)

  -- complete a variable as CTRL-X CTRL-O does
  find("R[vclear]")
  vim.fn.cursor(vim.fn.line("."), vim.fn.col(".") + 4)
  local list = ask("textDocument/completion")
  local labels = vim.tbl_map(function(item)
    return item.label
  end, list)
  check("variables are completed", vim.tbl_contains(labels, "vclear"))

  find("G81")
  local blocks = ask("textDocument/implementation")
  check("a line leads to its blocks", #blocks == 4)
  vim.lsp.buf.implementation()
  wait("they are listed to be gone to", function()
    return #vim.fn.getqflist() == 4
  end)
  vim.cmd("cclose")

  -- what lint can mend
  vim.cmd("edit! my.pf")
  vim.fn.setline(vim.fn.search("^G0 G90 G\\[work\\]"), "G0 G90G[work] X[h] Y[v]")
  wait("a missing blank is found", function()
    return #vim.diagnostic.get(0) > 0
  end)
  vim.lsp.buf.formatting_sync(nil, 60000)
  wait("laying the form out mends it", function()
    return #vim.diagnostic.get(0) == 0
  end)

  vim.cmd("edit! part.nc")
  check("a .nc file is a program", vim.bo.filetype == "nc")
  wait("what its control refuses is underlined", function()
    return #vim.diagnostic.get(0) > 0
  end)
end)
if not ran then
  fail(tostring(why))
end
io.write("Neovim " .. tostring(vim.version().major) .. "." .. tostring(vim.version().minor) .. ": all of it" .. "\n")
vim.cmd("qall!")
