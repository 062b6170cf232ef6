# Prints the cuts of a job in JSON Lines as blocks, in awk. Unchanged words are left out, and numbers have no leading or trailing zeros.
function number(value,    text) {
    text = sprintf("%.4f", value)
    sub(/0+$/, "", text)
    if (text == "0." || text == "-0.") return "0"
    sub(/^0/, "", text)
    sub(/^-0/, "-", text)
    return text
}
function word(letter, value,    text) {
    text = number(value)
    if (text == last[letter]) return ""
    last[letter] = text
    return letter text
}
BEGIN { FS = "[][,:}]+"; code = "G1"; feed = 1500 }
/^\{"line"/ {
    if ($5 != "") feed = $6
    block = code; code = ""
    for (i = 1; i <= 4; i++) {
        text = word(substr("XYZF", i, 1), i < 4 ? $(i + 1) : feed)
        if (text != "") block = block == "" ? text : block " " text
    }
    print block
}
